// A step of Newton's method for contact on the unknowns that its rows touch: many points a node make few unknowns.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "solver/contact_law/interpolated_step.hpp"
#include "solver/linear/dense_solve.hpp"
#include "solver/linear/row_matrix.hpp"

namespace comma::solver {

/// With S = A C A^T the jumps of interpolated_step.hpp are d = b_d + A w for displacements w of the support, so that
///     (1 - C A^T F_d A) w - C A^T F_l l = C A^T F_d b_d,     L_d A w + L_l l = b_l - L_d b_d
/// for the multipliers l. Stiff penalties tell jumps far smaller than w: one round of refinement on the equations
/// themselves gives them their digits.
class SupportStep {
 public:
  /// `rows`: A, of those of the step.
  SupportStep(const InterpolatedStep& step, RowMatrix rows, const Eigen::MatrixXd& compliance);
  /// x for b (one an unknown, jumps first), with the same compliance.
  Eigen::VectorXd solve(const Eigen::VectorXd& b, const Eigen::MatrixXd& compliance) const;

 private:
  Eigen::VectorXd solve_once(const Eigen::VectorXd& b, const Eigen::MatrixXd& compliance) const;
  Eigen::VectorXd left(const Eigen::VectorXd& b, const Eigen::VectorXd& x, const Eigen::MatrixXd& compliance) const;
  Eigen::Index row_count() const { return rows_.rows(); }
  Eigen::Index law_count() const { return weights_.size(); }

  RowMatrix rows_;                             ///< A
  Eigen::SparseMatrix<double> forces_, laws_;  ///< F and L
  Eigen::VectorXd weights_;                    ///< by which laws are lengths
  DenseSystem system_;
};

}  // namespace comma::solver
