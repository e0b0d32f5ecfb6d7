#include "solver/unilateral/active_cholesky.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Jacobi>

#include "solver/linear/dense_solve.hpp"

namespace comma::solver {

double ActiveCholesky::remaining_pivot(const Eigen::VectorXd& coupling, double diagonal) const {
  const auto factor = lower_.topLeftCorner(size_, size_).triangularView<Eigen::Lower>();
  return diagonal - factor.solve(coupling).squaredNorm();
}

bool ActiveCholesky::depends(const Eigen::VectorXd& coupling, double diagonal) const {
  return !(remaining_pivot(coupling, diagonal) > dependence_tolerance * diagonal);
}

bool ActiveCholesky::append(const Eigen::VectorXd& coupling, double diagonal) {
  assert(coupling.size() == size_);
  const Eigen::VectorXd row = lower_.topLeftCorner(size_, size_).triangularView<Eigen::Lower>().solve(coupling);
  const double pivot = diagonal - row.squaredNorm();
  if (!(pivot > dependence_tolerance * diagonal)) return false;
  grow(size_ + 1);
  lower_.row(size_).head(size_) = row.transpose();
  lower_(size_, size_) = std::sqrt(pivot);
  ++size_;
  return true;
}

bool ActiveCholesky::append_all(const Eigen::MatrixXd& coupling, const Eigen::MatrixXd& block) {
  assert(coupling.cols() == size_ && coupling.rows() == block.rows());
  const Eigen::Index count = block.rows();
  Eigen::MatrixXd across = coupling.transpose();
  Eigen::MatrixXd rest = block;
  if (size_ > 0) {
    lower_.topLeftCorner(size_, size_).triangularView<Eigen::Lower>().solveInPlace(across);
    rest.selfadjointView<Eigen::Lower>().rankUpdate(across.transpose(), -1.0);
  }
  if (!factorise_dense(rest)) return false;
  for (Eigen::Index i = 0; i < count; ++i)
    if (!(rest(i, i) * rest(i, i) > dependence_tolerance * block(i, i))) return false;
  grow(size_ + count);
  lower_.block(size_, 0, count, size_) = across.transpose();
  lower_.block(size_, size_, count, count).triangularView<Eigen::Lower>() = rest;
  size_ += static_cast<int>(count);
  return true;
}

/// By a half more each time, and by all that is asked for.
void ActiveCholesky::grow(Eigen::Index needed) {
  constexpr Eigen::Index least = 16;
  if (needed <= lower_.rows()) return;
  const Eigen::Index capacity = std::max({least, needed, lower_.rows() + lower_.rows() / 2});
  lower_.conservativeResize(capacity, capacity);
}

void ActiveCholesky::remove(int k) {
  assert(k >= 0 && k < size_);
  for (int i = k; i + 1 < size_; ++i) lower_.row(i).head(i + 2) = lower_.row(i + 1).head(i + 2).eval();
  --size_;
  // Row i >= k now reaches one column past the diagonal: rotate that entry away, column pair by column pair.
  for (int i = k; i < size_; ++i) {
    Eigen::JacobiRotation<double> rotation;
    double diagonal = 0.0;
    rotation.makeGivens(lower_(i, i), lower_(i, i + 1), &diagonal);
    for (int j = i; j < size_; ++j) {
      const double a = lower_(j, i);
      const double b = lower_(j, i + 1);
      lower_(j, i) = rotation.c() * a - rotation.s() * b;
      lower_(j, i + 1) = rotation.s() * a + rotation.c() * b;
    }
    if (lower_(i, i) < 0.0) lower_.col(i).segment(i, size_ - i) *= -1.0;
  }
}

Eigen::VectorXd ActiveCholesky::solve(const Eigen::VectorXd& rhs) const {
  assert(rhs.size() == size_);
  const auto factor = lower_.topLeftCorner(size_, size_);
  Eigen::VectorXd x = factor.triangularView<Eigen::Lower>().solve(rhs);
  factor.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  return x;
}

}  // namespace comma::solver
