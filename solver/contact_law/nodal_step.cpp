#include "solver/contact_law/nodal_step.hpp"

#include "solver/linear/dense_solve.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A column of the law that is this share of the others leaves its multiplier open.
constexpr double open_multiplier = 1e-10;

}  // namespace

bool has_points_on_nodes(const CondensedProblem& problem) {
  std::vector<char> taken(static_cast<std::size_t>(problem.node_count), 0);
  for (const CondensedPoint& point : problem.points) {
    if (point.node_count > 1) return false;
    if (point.rows == 0) continue;
    if (point.node_count != 1 || point.shape[0] != 1.0 || point.rows != point.components) return false;
    const auto node = static_cast<std::size_t>(point.nodes[0]);
    if (taken[node]++ || point.rows != (problem.is_smooth(point.nodes[0]) ? 1 : point.components)) return false;
  }
  return true;
}

NodalStep::NodalStep(const std::vector<int>& rows) : rows_(rows) {}

bool NodalStep::add_point(int first, const CondensedPoint& point, const ContactLaw& law, const ContactLawValue& value) {
  Point added;
  added.first = first;
  added.rows = point.rows;
  added.weight = point.weight;
  added.law = value;
  for (int c = 0; c < 3; ++c) {
    const double augmentation = c == 0 ? law.augmentation : law.friction_augmentation;
    const double scale = augmentation > 0.0 ? augmentation : 1.0;
    added.law.residual[c] *= scale;
    added.law.residual_by_jump.row(c) *= scale;
    added.law.residual_by_multiplier.row(c) *= scale;
  }
  const int n = point.rows;
  MatrixXd by_multiplier(2 * n, n);
  by_multiplier << added.law.traction_by_multiplier.topLeftCorner(n, n),
      added.law.residual_by_multiplier.topLeftCorner(n, n);
  const Eigen::ColPivHouseholderQR<MatrixXd> factor(by_multiplier);
  const VectorXd diagonal = factor.matrixR().diagonal().head(n).cwiseAbs();
  if (!(diagonal[n - 1] > open_multiplier * diagonal[0])) return false;
  const MatrixXd free = MatrixXd(factor.householderQ()).rightCols(n).transpose();  // of multipliers
  added.by_force = Matrix3d::Zero();
  added.by_jump = Matrix3d::Zero();
  added.constant = Vector3d::Zero();
  added.inverse.setZero();
  added.by_force.topLeftCorner(n, n) = free.leftCols(n) / point.weight;
  added.by_jump.topLeftCorner(n, n) = -free.leftCols(n) * added.law.traction_by_jump.topLeftCorner(n, n) -
                                      free.rightCols(n) * added.law.residual_by_jump.topLeftCorner(n, n);
  added.constant.head(n) = -free.rightCols(n) * added.law.residual.head(n);
  const MatrixXd inverse = factor.solve(MatrixXd::Identity(2 * n, 2 * n));
  added.inverse.topLeftCorner(n, n) = inverse.leftCols(n);
  added.inverse.block(0, 3, n, n) = inverse.rightCols(n);
  points_.push_back(added);
  changes_.push_back({point.nodes[0], n, Vector3d::Zero()});
  return true;
}

void NodalStep::add_spring(int place, double stiffness) {
  Point spring;
  spring.first = place;
  spring.rows = 1;
  spring.by_force = Matrix3d::Identity();
  spring.by_jump = -stiffness * Matrix3d::Identity();
  spring.constant = Vector3d::Zero();
  spring.inverse.setZero();
  has_springs_ = true;
  points_.push_back(spring);
  changes_.emplace_back();
}

VectorXd NodalStep::rhs(const VectorXd& balance) const {
  VectorXd result = VectorXd::Zero(balance.size());
  for (const Point& point : points_) {
    const int first = point.first, n = point.rows;
    result.segment(first, n) = point.constant.head(n) - point.by_jump.topLeftCorner(n, n) * balance.segment(first, n);
  }
  return result;
}

VectorXd NodalStep::solve(const SchurComplement& schur, const VectorXd& balance) {
  const auto count = static_cast<Index>(rows_.size());
  MatrixXd compliance(count, count);
  for (Index k = 0; k < count; ++k) {
    const SchurComplement::Column column = schur.column(rows_[static_cast<std::size_t>(k)]);
    for (Index i = 0; i < count; ++i) compliance(i, k) = column[rows_[static_cast<std::size_t>(i)]];
  }
  MatrixXd matrix = MatrixXd::Zero(count, count);
  for (const Point& point : points_) {
    const int first = point.first, n = point.rows;
    matrix.middleRows(first, n).noalias() = point.by_jump.topLeftCorner(n, n) * compliance.middleRows(first, n);
    matrix.block(first, first, n, n) += point.by_force.topLeftCorner(n, n);
  }
  const VectorXd forces = solve_dense(std::move(matrix), rhs(balance));
  VectorXd jumps = balance;
  jumps.noalias() += compliance * forces;
  take_multipliers(forces, jumps);
  return jumps;
}

/// Of equations that are pressures: as forces.
VectorXd NodalStep::weighted(VectorXd pressures) const {
  for (const Point& point : points_) pressures.segment(point.first, point.rows) *= point.weight;
  return pressures;
}

/// A_f f + A_d d, as forces.
VectorXd NodalStep::combined(const VectorXd& forces, const VectorXd& jumps) const {
  VectorXd result(forces.size());
  for (const Point& point : points_) {
    const int first = point.first, n = point.rows;
    result.segment(first, n) = point.weight * (point.by_force.topLeftCorner(n, n) * forces.segment(first, n) +
                                               point.by_jump.topLeftCorner(n, n) * jumps.segment(first, n));
  }
  return result;
}

std::vector<ForceBlock> NodalStep::blocks() const {
  std::vector<ForceBlock> result;
  for (const Point& point : points_)
    result.push_back({.place = point.first,
                      .row = rows_[static_cast<std::size_t>(point.first)],
                      .size = point.rows,
                      .by_force = point.weight * point.by_force,
                      .by_jump = point.weight * point.by_jump});
  return result;
}

std::optional<VectorXd> NodalStep::solve_by_products(SchurComplement& schur, const VectorXd& balance, NearInverse& near,
                                                     const GmresOptions& options) {
  std::vector<VectorXd> responses;
  // A spring as stiff as the body that comes off again leaves nothing of single precision.
  const auto product = [&](const VectorXd& forces) -> VectorXd {
    if (!has_springs_) return schur.times_roughly(rows_, forces);
    VectorXd all = VectorXd::Zero(schur.size());
    all(rows_) = forces;
    return schur.times(all)(rows_);
  };
  near.update(schur, blocks());
  const GmresSolution solution = solve_gmres(
      [&](const VectorXd& forces) {
        responses.push_back(product(forces));
        return combined(forces, responses.back());
      },
      [&](const VectorXd& b) { return near(b); }, weighted(rhs(balance)), options);
  if (!solution.reached) return std::nullopt;
  VectorXd jumps = balance;
  for (Index k = 0; k < solution.shares.size(); ++k)
    jumps += solution.shares[k] * responses[static_cast<std::size_t>(k)];
  take_multipliers(solution.x, jumps);
  return jumps;
}

void NodalStep::take_multipliers(const VectorXd& forces, const VectorXd& jumps) {
  force_changes_ = forces;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const Point& point = points_[p];
    Vector3d force = Vector3d::Zero(), jump = Vector3d::Zero();
    force.head(point.rows) = forces.segment(point.first, point.rows);
    jump.head(point.rows) = jumps.segment(point.first, point.rows);
    Eigen::Matrix<double, 6, 1> left;
    left << force / point.weight - point.law.traction_by_jump * jump,
        point.law.residual - point.law.residual_by_jump * jump;
    changes_[p].value = point.inverse * left;
  }
}

}  // namespace comma::solver
