// Dense systems whose unknowns differ in size by any number of decades.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Dense>

namespace comma::solver {

/// P M = L U for a square M (n x n), by LAPACK from `large_dense` unknowns on.
class DenseLu {
 public:
  explicit DenseLu(Eigen::MatrixXd matrix);
  /// x (n) with M x = b, not finite where a pivot vanished.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// The diagonal of U.
  Eigen::VectorXd pivots() const { return small_ ? small_->matrixLU().diagonal() : factors_.diagonal(); }

 private:
  std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> small_;
  Eigen::MatrixXd factors_;
  std::vector<int> interchanges_;
};

/// A square M (n x n): rows and columns are first brought to the size of one, then LU with row interchanges and one
/// step of refinement, by LAPACK on all cores from `large_dense` unknowns on. Where rows depend on each other, the x of
/// least size that comes nearest.
class DenseSystem {
 public:
  explicit DenseSystem(Eigen::MatrixXd matrix);
  /// x (n) with M x = b.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  Eigen::VectorXd column_scales_, row_scales_;
  Eigen::MatrixXd matrix_;         ///< of entries up to one
  std::optional<DenseLu> factor_;  ///< nothing where rows depend on each other
};

Eigen::VectorXd solve_dense(Eigen::MatrixXd matrix, const Eigen::VectorXd& rhs);

/// Overwrites the lower triangle of a positive definite S (n x n) by its Cholesky factor; what is above it stays.
/// False, and S is lost, where a pivot is not positive.
bool factorise_dense(Eigen::MatrixXd& lower);

/// S x (n) for a symmetric S (n x n) of which the lower triangle counts.
Eigen::VectorXd symmetric_product(const Eigen::MatrixXd& lower, const Eigen::VectorXd& x);

/// What is above the diagonal becomes what is below, or the other way round, in place.
void fill_upper(Eigen::MatrixXd& matrix);
void fill_lower(Eigen::MatrixXd& matrix);

/// The lower triangle of a symmetric matrix (n x n) in single precision.
class SingleTriangle {
 public:
  SingleTriangle() = default;
  explicit SingleTriangle(const Eigen::MatrixXd& lower);
  Eigen::Index size() const { return values_.rows(); }
  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const;

 private:
  Eigen::MatrixXf values_;  ///< what is above the diagonal is never written, and takes no memory where it is large
};

/// LAPACK gains more from here on than it takes to load it.
inline constexpr int large_dense = 200;

}  // namespace comma::solver
