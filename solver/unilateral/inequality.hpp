// Inequalities A u <= b with multipliers: the one object to which contact and unilateral conditions reduce.
#pragma once

#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace comma::solver {

/// Rows A u <= b over the free unknowns. The multipliers lambda >= 0 push back with the force -A^T lambda;
/// lambda_i (b_i - A_i u) = 0. A row with a softness s gives way instead: A_i u - b_i <= s_i lambda_i takes the place
/// of A_i u <= b_i.
struct Inequalities {
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows;
  Eigen::VectorXd bounds;
  Eigen::VectorXd softness{};  ///< one a row, in units of A u over those of lambda; empty: all zero
  Eigen::VectorXd sizes{};  ///< one a row: what bounds are small beside, in their units, where they are differences of
                            ///< larger things; empty: nothing

  double softness_of(Eigen::Index row) const { return softness.size() ? softness[row] : 0.0; }
};

}  // namespace comma::solver
