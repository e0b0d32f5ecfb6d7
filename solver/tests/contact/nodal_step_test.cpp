#include "solver/contact/nodal_step.hpp"

#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "solver/tests/contact/coupled_points.hpp"

using namespace comma::solver;

namespace {

/// Points on the nodes of a square grid of a surface, each with a force on it, whose compliance falls off with the distance as that of a half-space does.
struct Surface {
  static constexpr double friction = 0.4;
  CondensedProblem problem;
  CondensedState state;
  SchurComplement schur;

  explicit Surface(int edge) : schur(identity_rows(3 * edge * edge), inverse(edge)) {
    const int count = edge * edge;
    make_room(count, problem, state);
    for (int p = 0; p < count; ++p) {
      CondensedPoint point = point_on_node(p, 3, friction);
      point.weight = 1.0 / count;
      point.law.augmentation = point.law.friction_augmentation = count;
      problem.points.push_back(point);
      // Pressed on one side more than on the other, which stands open, and pulled along.
      const double x = static_cast<double>(p % edge) / edge;
      problem.free.segment<3>(3 * p) << -1.0 + 1.3 * x, 0.3, 0.1 * std::sin(p);
    }
  }

  static SchurComplement::ApplyInverse inverse(int edge) {
    const int count = edge * edge;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * count, 3 * count);
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < count; ++b) {
        const double distance = std::hypot(a % edge - b % edge, a / edge - b / edge);
        matrix.block<3, 3>(3 * a, 3 * b) = (a == b ? 2.5 : 1.0 / distance) * Eigen::Matrix3d::Identity();
      }
    return [matrix](Eigen::Ref<Eigen::MatrixXd> columns) { columns = matrix * columns; };
  }

  /// Multipliers on a grid twice as coarse, from which they are interpolated to the points.
  void share_multipliers(int edge) {
    const int cells = edge / 2;
    problem.node_count = (cells + 1) * (cells + 1);
    state.multipliers = Eigen::VectorXd::Zero(3 * problem.node_count);
    for (int p = 0; p < edge * edge; ++p) {
      const int column = p % edge, row = p / edge;
      const int first = row / 2 * (cells + 1) + column / 2;
      const double x = column % 2 ? 0.75 : 0.25, y = row % 2 ? 0.75 : 0.25;
      CondensedPoint& point = problem.points[static_cast<std::size_t>(p)];
      point.node_count = 4;
      point.nodes = {first, first + 1, first + cells + 1, first + cells + 2};
      point.shape = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    }
  }

  std::array<int, 3> counts() const {
    std::array<int, 3> result{};
    for (const ContactStatus status : state.statuses) ++result[static_cast<std::size_t>(status)];
    return result;
  }
};

}  // namespace

TEST_CASE("Contact solved by products with the compliance is that of the direct way") {
  Surface direct(12), by_products(12);
  by_products.problem.direct_rows = 0;
  by_products.problem.most_direct_rows = 0;
  const CondensedSolution expected = solve_condensed(direct.schur, direct.problem, direct.state);
  const CondensedSolution solution = solve_condensed(by_products.schur, by_products.problem, by_products.state);
  REQUIRE(expected.verdict == CondensedVerdict::solved);
  REQUIRE(solution.verdict == CondensedVerdict::solved);
  for (const int count : direct.counts()) CHECK(count > 0);
  CHECK(by_products.state.statuses == direct.state.statuses);
  CHECK((solution.forces - expected.forces).norm() < 1e-10 * expected.forces.norm());
  CHECK((by_products.state.multipliers - direct.state.multipliers).norm() < 1e-10 * direct.state.multipliers.norm());
}

TEST_CASE("So is contact whose multipliers are interpolated to points between nodes") {
  Surface direct(12), by_products(12), followed(12);
  for (Surface* each : {&direct, &by_products, &followed}) each->share_multipliers(12);
  for (Surface* each : {&by_products, &followed}) each->problem.direct_rows = 0;
  followed.problem.most_products = 1;
  const CondensedSolution expected = solve_condensed(direct.schur, direct.problem, direct.state);
  REQUIRE(expected.verdict == CondensedVerdict::solved);
  for (const int count : direct.counts()) CHECK(count > 0);
  for (Surface* each : {&by_products, &followed}) {
    const CondensedSolution solution = solve_condensed(each->schur, each->problem, each->state);
    REQUIRE(solution.verdict == CondensedVerdict::solved);
    CHECK(each->state.statuses == direct.state.statuses);
    CHECK((solution.forces - expected.forces).norm() < 1e-9 * expected.forces.norm());
  }
  CHECK(followed.state.multipliers == direct.state.multipliers);
  CHECK(by_products.state.multipliers != direct.state.multipliers);
}

TEST_CASE("Where products with the compliance lead nowhere, the direct way follows, or no solution") {
  Surface direct(12), followed(12), bounded(12);
  for (Surface* each : {&followed, &bounded}) {
    each->problem.direct_rows = 0;
    each->problem.most_products = 2;
  }
  bounded.problem.most_direct_rows = 0;
  const CondensedSolution expected = solve_condensed(direct.schur, direct.problem, direct.state);
  const CondensedSolution solution = solve_condensed(followed.schur, followed.problem, followed.state);
  REQUIRE(solution.verdict == CondensedVerdict::solved);
  CHECK((solution.forces - expected.forces).norm() == 0.0);
  CHECK(solve_condensed(bounded.schur, bounded.problem, bounded.state).verdict == CondensedVerdict::too_many_iterations);
}
