// Eigen's simplicial LDL^T: for small systems, no library to load.
#pragma once

#include <memory>

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

std::unique_ptr<LinearSolver> make_eigen_ldlt_solver(const LinearOptions& options);

}  // namespace comma::solver
