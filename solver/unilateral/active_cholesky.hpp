// Cholesky factor of a principal submatrix that grows and shrinks by one row at a time.
#pragma once

#include <vector>

#include <Eigen/Dense>

namespace comma::solver {

/// L L^T = S restricted to the rows appended so far, in the order in which they came. Appending costs O(m^2), removing
/// O(m^2) by Givens rotations (Golub and Van Loan, Matrix Computations, section 6.5.4).
class ActiveCholesky {
 public:
  int size() const { return size_; }
  void clear() { size_ = 0; }

  /// Appends a row: `coupling` (m) is S between the new row and those present, `diagonal` its own entry. Returns false,
  /// and leaves the factor as it was, when the row depends on those present within `dependence_tolerance`.
  bool append(const Eigen::VectorXd& coupling, double diagonal);

  /// Appends many rows at once: `coupling` (k x m) and `block` (k x k, its lower triangle) are S between them and those
  /// present, and among themselves. False, and the factor as it was, when one of them depends on the others or on those
  /// present.
  bool append_all(const Eigen::MatrixXd& coupling, const Eigen::MatrixXd& block);

  /// What is left of a row's own entry once those present are eliminated: diagonal - coupling^T S^-1 coupling.
  double remaining_pivot(const Eigen::VectorXd& coupling, double diagonal) const;
  bool depends(const Eigen::VectorXd& coupling, double diagonal) const;

  /// Removes the k-th of the rows present; those after it move up.
  void remove(int k);

  /// S^-1 rhs.
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const;

 private:
  void grow(Eigen::Index needed);

  Eigen::MatrixXd lower_;
  int size_ = 0;
};

/// A pivot below this share of its initial diagonal is a linear dependence: S is made of solutions that a direct solver
/// refines to nearly full precision, so that what is left below a few thousand roundings is noise.
inline constexpr double dependence_tolerance = 1e-12;

}  // namespace comma::solver
