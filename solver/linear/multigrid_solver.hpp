// Conjugate gradients preconditioned by multigrid: time and memory in proportion to the unknowns, for large solids.
#pragma once

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// Needs LinearOptions::solid. Flexible conjugate gradients with one V-cycle of multigrid.hpp a step, until the energy
/// norm of the error, estimated by sqrt(r.M^-1 r) with M the cycle, falls to `multigrid_tolerance` of the solution's.
/// It sees no pivots: a body that nothing holds must be looked for by its rigid motions. factorise() reports
/// `indefinite` where the matrix turns out not to be positive definite; solve() throws Error `no-convergence` after
/// `most_multigrid_iterations` (nearly incompressible or very flat elements): take a direct solver then.
std::unique_ptr<LinearSolver> make_multigrid_solver(const LinearOptions& options);

/// Four digits below what verdicts compare.
inline constexpr double multigrid_tolerance = 1e-11;
/// A sound solid of steel takes 15 to 40.
inline constexpr int most_multigrid_iterations = 100;

}  // namespace comma::solver
