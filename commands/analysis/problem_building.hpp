// What the commands that solve share: the problem behind MODELE, CHAM_MATER, CARA_ELEM and EXCIT, and the choice of the
// linear solver.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "commands/concepts.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/fields/field_computation.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::commands {

/// Model, materials, properties and loads; contact is the nonlinear command's own.
solver::StaticProblem static_problem(const interpreter::Call& call);

/// The loads of EXCIT, in place of those of the problem. A load that stands there twice is an error
/// (`repeated-load`), as in Code_Aster 17.3.
void take_loads(const interpreter::Keywords& keywords, solver::StaticProblem& problem);

/// The problem that a step of a result (null: its last phase) was computed from, but for what MODELE, CHAM_MATER,
/// CARA_ELEM and EXCIT give in its place. Throws DiagnosticError `missing-keyword` where neither gives a model or
/// materials.
solver::StaticProblem problem_of_result(const interpreter::Call& call, const ResultConcept& source,
                                        const solver::ResultStep* step = nullptr);

/// What ResultConcept::sources is to say of a command with MODELE, CHAM_MATER and CARA_ELEM.
std::map<std::string, std::string> numbered_sources(const interpreter::Call& call);

/// The result to go on with (reuse=), its steps up to `last_order` if it is given: what they were computed from is kept
/// as an earlier phase.
std::shared_ptr<ResultConcept> to_go_on_with(const interpreter::Call& call, std::optional<int> last_order = {});

/// Throws DiagnosticError `out-of-function` where a tabulated FONC_MULT has no value at one of the instants.
void check_multipliers(const interpreter::Call& call, std::span<const double> instants);

/// Raises an alarm where fields of the RESULTAT that CALC_CHAMP computed on some cells only have been taken for those
/// of the whole model.
void warn_of_limited_fields(const interpreter::Call& call, const std::set<std::string>& fields,
                            interpreter::Diagnostics& diagnostics);

/// Fields of a result's steps, each computed from what its step was computed from, as problem_of_result() has it. Keeps
/// references to its arguments.
class FieldsOfSteps {
 public:
  /// Throws what problem_of_result() does.
  FieldsOfSteps(const interpreter::Call& call, const ResultConcept& source);
  FieldsOfSteps(const FieldsOfSteps&) = delete;
  FieldsOfSteps& operator=(const FieldsOfSteps&) = delete;

  const solver::StaticProblem& problem() const { return phases_.back().problem; }
  /// See FieldComputation.
  solver::Field compute(std::string_view name, std::size_t step, std::optional<std::span<const int>> cells = {});
  bool stores_potential_energy(std::size_t step) { return computation_of(step).stores_potential_energy(step); }
  /// Where CHAM_MATER or CARA_ELEM are not those that the result was computed with.
  void warn_of_other_materials(interpreter::Diagnostics& diagnostics) const;
  /// For the fields of the result that have been used since.
  void warn_of_limited_sources(interpreter::Diagnostics& diagnostics) const;

 private:
  struct Phase {
    std::size_t begin;
    std::size_t end;  ///< the number of the first step after it
    solver::StaticProblem problem;
    std::unique_ptr<solver::FieldComputation> computation;
  };

  solver::FieldComputation& computation_of(std::size_t step);

  const interpreter::Call& call_;
  const ResultConcept& source_;
  std::vector<Phase> phases_;  ///< not empty
};

struct SolverChoice {
  std::optional<solver::LinearMethod> method;  ///< empty: the file does not say, comma takes the fastest that is safe
  solver::LinearOptions options;
};

/// The keyword SOLVEUR (U4.50.01).
SolverChoice solver_choice(const interpreter::Call& call);

}  // namespace comma::commands
