#include "solver/contact_law/condensed_problem.hpp"

#include <algorithm>

namespace comma::solver {

using Eigen::Index;
using Eigen::Vector3d;

const Eigen::VectorXd& first_jumps(const CondensedProblem& problem) {
  return problem.begin.size() > 0 ? problem.begin : problem.free;
}

bool has_penalty(const CondensedProblem& problem) {
  return std::ranges::any_of(
      problem.points, [](const CondensedPoint& point) { return point.law.penalised || point.law.friction_penalised; });
}

Vector3d multiplier_at(const CondensedProblem& problem, const CondensedState& state, const CondensedPoint& point) {
  Vector3d value = Vector3d::Zero();
  for (int i = 0; i < point.node_count; ++i)
    for (int c = 0; c < problem.components; ++c)
      value[c] += point.shape[i] * state.multipliers[point.nodes[i] * problem.components + c];
  return value;
}

Vector3d at_point(const CondensedPoint& point, const Eigen::VectorXd& on_rows) {
  Vector3d value = Vector3d::Zero();
  value.head(point.rows) = on_rows.segment(point.first_row, point.rows);
  return value;
}

Eigen::MatrixXd resisting_rows(const CondensedPoint& point) {
  const bool rubs = point.law.friction > 0.0, has_dead = point.rows == 3 && !point.law.dead.isZero();
  const int count = !rubs ? 1 : has_dead ? 2 : point.rows;
  Eigen::MatrixXd result = Eigen::MatrixXd::Identity(count, point.rows);
  if (rubs && has_dead) result.row(1) << 0.0, -point.law.dead[1], point.law.dead[0];
  return result;
}

double slip_of(const CondensedPoint& point, const Eigen::VectorXd& jumps) {
  if (point.rows < 2) return 0.0;
  return live_part(point.law, at_point(point, jumps)).tail<2>().norm();
}

std::vector<char> shared_multipliers(const CondensedProblem& problem) {
  std::vector<char> shared(static_cast<std::size_t>(problem.node_count), 0), taken = shared;
  for (const CondensedPoint& point : problem.points)
    for (int i = 0; i < point.node_count; ++i) {
      const auto node = static_cast<std::size_t>(point.nodes[static_cast<std::size_t>(i)]);
      if (point.node_count > 1 || taken[node]) shared[node] = 1;
      if (point.rows > 0) taken[node] = 1;
    }
  return shared;
}

Eigen::VectorXd multiplier_forces(const CondensedProblem& problem, const CondensedState& state, Index rows) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(rows);
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    const CondensedPoint& point = problem.points[p];
    if (point.rows == 0 || state.statuses[p] == ContactStatus::open) continue;
    const Vector3d multiplier = live_part(point.law, multiplier_at(problem, state, point));
    const double of_shear =
        point.law.share_pressure > 0.0 ? std::max(0.0, multiplier[0]) / point.law.share_pressure : 1.0;
    for (int c = 0; c < point.rows; ++c)
      forces[point.first_row + c] = (c == 0 ? 1.0 : -of_shear) * point.weight * multiplier[c];
  }
  return forces;
}

}  // namespace comma::solver
