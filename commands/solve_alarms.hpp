// What the commands that solve tell about a solution that may be far from that of the body although the equations were solved.
#pragma once

#include <set>

#include "commands/concepts.hpp"
#include "commands/context.hpp"
#include "interpreter/call.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::commands {

/// Alarm `near-incompressible`: cells that lock.
void warn_of_locking(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context);

/// Alarm `repeated-load`: a load that EXCIT names more than once.
void warn_of_repeated_loads(const interpreter::Call& call, Context& context);

/// Alarms `no-density`, where weight or rotation acts on a material without one, and `no-expansion`, where nothing depends on a temperature or drying that is given.
void warn_of_missing_data(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context);

/// Alarm `strained-start`: a computation begins at an instant where command variables strain the body already, without an initial state.
void warn_of_strained_start(const interpreter::Call& call, const solver::StaticProblem& problem, double instant, Context& context);

/// Alarm `no-behaviour`: cells that COMPORTEMENT leaves out.
void warn_of_cells_without_behaviour(const interpreter::Call& call, const solver::Model& model, Context& context);

/// Alarm `other-variables`: a cell goes on with a law whose internal variables are others than those it had. `before`: the laws of the initial state; null: elasticity, or not known.
void warn_of_other_laws(const interpreter::Call& call, const solver::BehaviourOfCells* before, const solver::StaticProblem& problem, Context& context);

/// Alarm `released-points`: a contact with GLISSIERE goes on from fields, which do not say what points it holds.
void warn_of_released_points(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context);

/// Alarm `no-internal-variables`: materials that remember go on from displacements without what they remembered.
void warn_of_missing_state(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context);
void warn_of_forgotten_flow(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context);
void warn_of_lost_variables(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context);

/// Alarm `initial-strains`: loads give initial strains to materials that remember, where what Code_Aster does with them is not known.
void warn_of_initial_strains(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context);

/// Alarm `indefinite-stiffness`, if a factorisation since `counters_before` met a stiffness that is not positive definite.
void warn_of_indefinite_stiffness(const interpreter::Call& call, const solver::Counters& counters_before, Context& context);

/// Alarms `soft-penalty`, `soft-friction-penalty`, `held-overlap`, `coarse-slave` on what may be wrong with the contact and the bounds of a solution.
void warn_of_contact(const interpreter::Call& call, const solver::StaticProblem& problem, const solver::ContactDoubts& doubts, Context& context);

/// Alarm `not-converged`: steps that stand all the same (ARRET='NON'), by their instants.
void warn_of_unconverged_steps(const interpreter::Call& call, const std::set<double>& instants, Context& context);

/// Alarm `coarse-turns`, where beams in large rotations have turned so far in their steps that they are longer for it.
void warn_of_turns(const interpreter::Call& call, const ResultConcept& product, Context& context);

}  // namespace comma::commands
