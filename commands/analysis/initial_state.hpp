// Where a nonlinear computation starts from (STAT_NON_LINE, ETAT_INIT; U4.51.03).
#pragma once

#include <memory>
#include <optional>

#include "commands/concepts.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

struct InitialStateChoice {
  std::shared_ptr<const solver::InitialState> state;  ///< null without ETAT_INIT
  std::optional<double> instant;                      ///< of the step of EVOL_NOLI, or INST_ETAT_INIT
  std::optional<int> order;                           ///< NUME_ORDRE of that step
  /// That it was computed with; null: elasticity, or not known.
  std::shared_ptr<const solver::BehaviourOfCells> behaviours;
};

/// The step of EVOL_NOLI that NUME_ORDRE or INST names, the last one without; DEPL, SIGM and VARI in the place of its
/// fields. Throws DiagnosticError `unknown-step`, `wrong-type` for a field of another kind.
InitialStateChoice initial_state(const interpreter::Call& call);

/// Throws DiagnosticError `unsupported` where a law does not start from the stresses that are given: those of
/// hyperelasticity follow from the displacement, those of SIMO_MIEHE from the internal variables (R5.03.21). Where
/// these are given too they are taken for a state of the law.
void check_initial_stresses(const interpreter::Call& call, const solver::StaticProblem& problem);

/// Cells that were elastic had nothing to remember: in another law of small displacements their variables begin at
/// zero, whatever those of other cells are. `before`: what the state was computed with; may be null.
void complete_variables(solver::StaticProblem& problem, const solver::BehaviourOfCells* before);

/// Throws DiagnosticError `unsupported` where a beam that GROT_GDEP has turned goes on in small displacements: its
/// forces are along axes that it has no longer.
void check_turned_beams(const interpreter::Call& call, const solver::StaticProblem& problem,
                        const solver::BehaviourOfCells* before);

}  // namespace comma::commands
