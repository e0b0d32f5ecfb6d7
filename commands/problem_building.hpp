// What the commands that solve share: the problem behind MODELE, CHAM_MATER, CARA_ELEM and EXCIT, and the choice of the
// linear solver.
#pragma once

#include <optional>

#include "commands/concepts.hpp"
#include "interpreter/call.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::commands {

/// Model, materials, properties and loads; contact is the nonlinear command's own.
solver::StaticProblem static_problem(const interpreter::Call& call);

/// The loads of EXCIT, in place of those of the problem.
void take_loads(const interpreter::Keywords& keywords, solver::StaticProblem& problem);

/// The problem that a result was computed from, but for what MODELE, CHAM_MATER, CARA_ELEM and EXCIT give in its place. Throws DiagnosticError
/// `missing-keyword` where neither gives a model or materials.
solver::StaticProblem problem_of_result(const interpreter::Call& call, const ResultConcept& source);

struct SolverChoice {
  std::optional<solver::LinearMethod> method;  ///< empty: the file does not say, comma takes the fastest that is safe
  solver::LinearOptions options;
};

/// The keyword SOLVEUR (U4.50.01).
SolverChoice solver_choice(const interpreter::Call& call);

}  // namespace comma::commands
