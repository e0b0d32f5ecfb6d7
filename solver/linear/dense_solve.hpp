// Dense systems whose unknowns differ in size by any number of decades.
#pragma once

#include <Eigen/Dense>

namespace comma::solver {

/// x (n) with M x = b for a square M (n x n): rows and columns are first brought to the size of one, then LU with row interchanges and one step of
/// refinement, by LAPACK on all cores from `large_dense` unknowns on. Where rows depend on each other, the x of least size that comes nearest.
Eigen::VectorXd solve_dense(Eigen::MatrixXd matrix, Eigen::VectorXd rhs);

/// Overwrites the lower triangle of a positive definite S (n x n) by its Cholesky factor; what is above it stays. False, and S is lost, where a
/// pivot is not positive.
bool factorise_dense(Eigen::MatrixXd& lower);

/// LAPACK gains more from here on than it takes to load it.
inline constexpr int large_dense = 200;

}  // namespace comma::solver
