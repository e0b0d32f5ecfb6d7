#include <random>

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/coupled_points.hpp"

using namespace comma::solver;

namespace stiff_penalties_test {

constexpr int nodes = 5, faces = 4;

/// The axes of a face that is nearly level, one a row: its normal and two tangents.
Eigen::Matrix3d axes(double tilt_x, double tilt_y) {
  Eigen::Matrix3d result;
  result.row(0) = Eigen::RowVector3d(tilt_x, tilt_y, 1.0).normalized();
  result.row(1) = Eigen::RowVector3d(1.0, 0.0, -tilt_x).normalized();
  result.row(2) = Eigen::Vector3d(result.row(0)).cross(Eigen::Vector3d(result.row(1)));
  return result;
}

TEST_CASE("Friction beside penalties far stiffer than the bodies is solved from softer ones") {
  // Each node belongs to as many faces, of other normals, and has a point on each of them.
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int trial = 0; trial < 2; ++trial) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3 * faces * nodes, 3 * nodes);
    CondensedProblem problem;
    CondensedState state;
    make_room(faces * nodes, problem, state);
    problem.node_count = nodes;
    state.multipliers = Eigen::VectorXd::Zero(3 * nodes);
    for (int k = 0; k < faces * nodes; ++k) {
      CondensedPoint point = point_on_node(k, 3, 0.9);
      point.nodes[0] = k / faces;
      point.law.penalised = true;
      point.law.augmentation = 1e6;
      point.share_augmentation = 100.0;
      point.weight = 1.0 / faces;
      problem.points.push_back(point);
      rows.block<3, 3>(3 * k, 3 * point.nodes[0]) = axes(0.03 * any(generator), 0.03 * any(generator));
    }
    const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(3 * nodes, 3 * nodes, [&] { return any(generator); });
    SchurComplement schur(rows.sparseView(),
                          [compliance = Eigen::MatrixXd(half * half.transpose())](Eigen::Ref<Eigen::MatrixXd> columns) {
                            columns = compliance * columns;
                          });
    Eigen::VectorXd moved = Eigen::VectorXd::NullaryExpr(3 * nodes, [&] { return any(generator); });
    for (int n = 0; n < nodes; ++n) moved[3 * n + 2] -= 0.5;
    problem.free = rows * moved;
    CAPTURE(trial);
    CHECK(solve_condensed(schur, problem, state).verdict == CondensedVerdict::solved);
  }
}

}  // namespace stiff_penalties_test
