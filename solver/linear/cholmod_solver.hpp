// CHOLMOD: supernodal Cholesky factors, simplicial LDL^T where the matrix is not positive definite.
#pragma once

#include <memory>

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

std::unique_ptr<LinearSolver> make_cholmod_solver(const LinearOptions& options);

}  // namespace comma::solver
