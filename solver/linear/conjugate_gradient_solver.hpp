// Preconditioned conjugate gradients: no factor, little memory, for large well-conditioned bodies (R6.01.02).
#pragma once

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// Preconditioned by an incomplete Cholesky factor on the pattern of the matrix (Lin, More, "Incomplete Cholesky
/// factorizations with limited memory", SIAM J. Sci. Comput. 21, 1999), as Eigen has it. Iterates until
/// |b - A x|_2 <= LinearOptions::iteration_tolerance |b|_2. It finds no null pivots: a body that nothing holds must be
/// looked for by its rigid motions. solve() throws Error `no-convergence` after LinearOptions::most_iterations.
std::unique_ptr<LinearSolver> make_conjugate_gradient_solver(const LinearOptions& options);

}  // namespace comma::solver
