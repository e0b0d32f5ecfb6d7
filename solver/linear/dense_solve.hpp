// Dense systems whose unknowns differ in size by any number of decades.
#pragma once

#include <Eigen/Dense>

namespace comma::solver {

/// x (n) with M x = b for a square M (n x n): rows and columns are first brought to the size of one, then LU with row interchanges and one step of
/// refinement, by LAPACK on all cores from `large_dense` unknowns on. Where rows depend on each other, the x of least size that comes nearest.
Eigen::VectorXd solve_dense(Eigen::MatrixXd matrix, Eigen::VectorXd rhs);

/// LAPACK gains more from here on than it takes to load it.
inline constexpr int large_dense = 200;

}  // namespace comma::solver
