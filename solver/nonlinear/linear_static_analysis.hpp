// Linear statics over a list of instants: one factorisation as long as the stiffness stays the same.
#pragma once

#include <span>

#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

struct LinearStaticOptions {
  std::optional<LinearMethod> method;  ///< empty: chosen for the matrix
  LinearOptions linear;
  bool stresses = true;  ///< archive SIEF_ELGA besides DEPL
};

/// Throws what solve_linear_static() can tell before it solves.
void require_solvable(const StaticProblem& problem, const LinearStaticOptions& options);

/// Solves K(t) u = f_ext(t) + f_strains(t) under the conditions of the loads at each instant, the strains being those
/// of the command variables, and appends a step for each to `result` (orders from 1 on, or after those it has): DEPL,
/// SIEF_ELGA. K is factorised again only where command variables or time change material properties. Instants are
/// independent of each other. Errors: `unsupported` for a problem with contact or unilateral conditions,
/// `singular-matrix` (nodes, components, rigid motion), `contradictory-conditions`, those of materials and functions.
/// Steps already appended stay when it throws.
void solve_linear_static(const StaticProblem& problem, std::span<const double> instants,
                         const LinearStaticOptions& options, Result& result, Counters& counters);

}  // namespace comma::solver
