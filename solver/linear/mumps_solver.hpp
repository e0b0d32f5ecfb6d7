// MUMPS, sequential: LDL^T with 1x1 and 2x2 pivots for any symmetric matrix.
#pragma once

#include <memory>

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

std::unique_ptr<LinearSolver> make_mumps_solver(const LinearOptions& options);

}  // namespace comma::solver
