#include "solver/linear/gmres.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Jacobi>

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The Krylov space of M P and b, and the least-squares problem on it.
class KrylovSpace {
 public:
  KrylovSpace(const LinearMap& matrix, const LinearMap& preconditioner, const VectorXd& b, int most)
      : matrix_(matrix),
        preconditioner_(preconditioner),
        triangle_(MatrixXd::Zero(most, most)),
        rhs_(VectorXd::Zero(most + 1)) {
    rhs_[0] = b.norm();
    basis_.push_back(b / rhs_[0]);
  }

  double residual() const { return std::abs(rhs_[size()]); }
  Index size() const { return static_cast<Index>(given_.size()); }

  /// False where there is nothing to be added.
  bool grow() {
    const Index k = size();
    given_.push_back(preconditioner_(basis_.back()));
    VectorXd next = matrix_(given_.back());
    VectorXd column = VectorXd::Zero(k + 2);
    const double size_before = next.norm();
    for (int pass = 0; pass < 2; ++pass)  // the second for what rounding leaves of the first
      for (Index i = 0; i <= k; ++i) {
        const double along = basis_[static_cast<std::size_t>(i)].dot(next);
        column[i] += along;
        next -= along * basis_[static_cast<std::size_t>(i)];
      }
    column[k + 1] = next.norm();
    const bool grows = column[k + 1] > independent * size_before;
    if (grows) basis_.push_back(next / column[k + 1]);
    rotate(column);
    return grows;
  }

  VectorXd shares() const {
    return triangle_.topLeftCorner(size(), size()).triangularView<Eigen::Upper>().solve(rhs_.head(size()));
  }

  VectorXd combined(const VectorXd& shares) const {
    VectorXd sum = VectorXd::Zero(basis_.front().size());
    for (Index i = 0; i < shares.size(); ++i) sum += shares[i] * given_[static_cast<std::size_t>(i)];
    return sum;
  }

 private:
  /// What is left of a vector by this share is rounding.
  static constexpr double independent = 1e-14;

  void rotate(VectorXd column) {
    const Index k = static_cast<Index>(rotations_.size());
    for (Index i = 0; i < k; ++i) column.applyOnTheLeft(i, i + 1, rotations_[static_cast<std::size_t>(i)].adjoint());
    Eigen::JacobiRotation<double> rotation;
    rotation.makeGivens(column[k], column[k + 1]);
    column.applyOnTheLeft(k, k + 1, rotation.adjoint());
    rhs_.applyOnTheLeft(k, k + 1, rotation.adjoint());
    rotations_.push_back(rotation);
    triangle_.col(k).head(k + 1) = column.head(k + 1);
  }

  const LinearMap& matrix_;
  const LinearMap& preconditioner_;
  std::vector<VectorXd> basis_, given_;
  std::vector<Eigen::JacobiRotation<double>> rotations_;
  MatrixXd triangle_;
  VectorXd rhs_;
};

}  // namespace

GmresSolution solve_gmres(const LinearMap& matrix, const LinearMap& preconditioner, const VectorXd& b,
                          const GmresOptions& options) {
  GmresSolution solution;
  const double size = b.norm();
  if (!(size > 0.0) || !std::isfinite(size)) {
    solution.x = VectorXd::Zero(b.size());
    solution.reached = size == 0.0;
    return solution;
  }
  KrylovSpace space(matrix, preconditioner, b, options.most_products);
  bool grows = true;
  while (grows && space.size() < options.most_products && !(space.residual() <= options.tolerance * size))
    grows = space.grow();
  solution.shares = space.shares();
  solution.x = space.combined(solution.shares);
  solution.reached = space.residual() <= options.tolerance * size && solution.x.allFinite();
  return solution;
}

}  // namespace comma::solver
