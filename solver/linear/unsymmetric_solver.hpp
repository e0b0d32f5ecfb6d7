// Unsymmetric systems: what springs without a potential, friction and loads that follow the body add to a stiffness.
//
// Almost all of such a matrix is symmetric, and models without those parts must not pay for them. So K = S + W is kept
// in two: S symmetric, as everywhere else, and the skew-symmetric W, which has entries only where an element needs
// them.
#pragma once

#include <memory>

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// Skew-symmetric, W^T = -W; only the strict lower triangle is stored.
using SkewMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
/// Any square matrix, all its entries stored.
using GeneralMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// S + W (n x n).
GeneralMatrix full_matrix(const SymmetricMatrix& symmetric, const SkewMatrix& skew);

/// K^T K, lower triangle. What K does not resist, this does not either: |K x|^2 = x . K^T K x. It lets motions that
/// nothing holds be named where K itself is not symmetric; its entries are squares, so that digits count double.
SymmetricMatrix gram_matrix(const GeneralMatrix& matrix);

/// Up to here SparseLU takes less time than loading MUMPS does (docs/linear_solvers.md).
inline constexpr int small_unsymmetric_system = 1000;

/// P A Q = L U with partial pivoting of the matrix equilibrated by rows and columns: up to `small_unsymmetric_system`
/// rows by Eigen's SparseLU (after Demmel, Eisenstat, Gilbert, Li, Liu, "A supernodal approach to sparse partial
/// pivoting", SIAM J. Matrix Anal. Appl. 20, 1999), beyond by MUMPS. Solutions are refined as those of symmetric
/// systems (refinement.hpp).
class UnsymmetricSolver {
 public:
  class Factors;

  explicit UnsymmetricSolver(const LinearOptions& options);
  ~UnsymmetricSolver();

  /// Analysis and factorisation; keeps a copy for refinement. Verdict `ok` or `singular`: a pivot of the equilibrated
  /// matrix below 10^-singular_digits of the largest entry in its column is null; `null_rows` are the unknowns
  /// (columns) behind them. Throws Error `not-finite` as LinearSolver::factorise, `out-of-memory`.
  FactorReport factorise(const SymmetricMatrix& symmetric, const SkewMatrix& skew);

  /// rhs: n x k, overwritten by the solution. Returns the largest relative residual of the columns. Throws Error
  /// `singular-matrix` after a factorisation that was, `inaccurate-solution` if the residual stays above
  /// LinearSolver::worst_residual.
  double solve(Eigen::Ref<Eigen::MatrixXd> rhs) const;

 private:
  void factorise_scaled(const GeneralMatrix& working);

  LinearOptions options_;
  GeneralMatrix matrix_;
  Eigen::VectorXd row_factors_, column_factors_;
  double norm_ = 0.0;
  std::unique_ptr<Factors> factors_;
  FactorReport report_;
};

}  // namespace comma::solver
