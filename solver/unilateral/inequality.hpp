// Inequalities A u <= b with multipliers: the one object to which contact and unilateral conditions reduce.
#pragma once

#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace comma::solver {

/// Rows A u <= b over the free unknowns. The multipliers lambda >= 0 push back with the force -A^T lambda;
/// lambda_i (b_i - A_i u) = 0.
struct Inequalities {
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows;
  Eigen::VectorXd bounds;
};

}  // namespace comma::solver
