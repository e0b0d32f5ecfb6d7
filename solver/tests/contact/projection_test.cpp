#include "solver/contact/projection.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// What Newton's method leaves that stops at a step of a ten-thousandth, as on a place: its square.
constexpr double place_accuracy = 1e-7;

}  // namespace

TEST_CASE("On a segment: foot, weights, distance, and how far outside") {
  const std::vector<Vector3d> segment = {{0, 0, 0}, {4, 0, 0}};
  const auto inside = project({1, 3, 0}, CellType::seg2, segment);
  REQUIRE(inside);
  CHECK(inside->xi[0] == exactly(-0.5));
  CHECK(inside->weights[0] == exactly(0.75));
  CHECK(inside->distance == exactly(3.0));
  CHECK(inside->outside == 0.0);
  const auto beyond = project({5, 3, 0}, CellType::seg2, segment);
  REQUIRE(beyond);
  CHECK(beyond->outside == exactly(0.5));
  CHECK(beyond->weights[1] == 1.0);
  CHECK((beyond->foot - Vector3d(4, 0, 0)).norm() == 0.0);
  CHECK(beyond->distance == exactly(std::sqrt(10.0)));
}

TEST_CASE("On a parabola the offset is orthogonal to the tangent") {
  const std::vector<Vector3d> arc = {{-1, 0, 0}, {1, 0, 0}, {0, 0.4, 0}};
  for (const double x : {-0.8, -0.3, 0.0, 0.5, 0.9}) {
    const Vector3d node(x, 1.0, 0);
    const auto projection = project(node, CellType::seg3, arc);
    REQUIRE(projection);
    const auto tangents = facet_tangents(CellType::seg3, arc, projection->xi);
    CHECK(std::abs(tangents.col(0).dot(projection->foot - node)) < place_accuracy);
  }
}

TEST_CASE("On warped and curved faces a lifted point comes back to where it was lifted") {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> noise(-0.08, 0.08);
  for (const CellType type :
       {CellType::tria3, CellType::tria6, CellType::tria7, CellType::quad4, CellType::quad8, CellType::quad9}) {
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<Vector3d> points;
      for (int i = 0; i < node_count(type); ++i) {
        const Vector2d xi = facet_node(type, i);
        points.emplace_back(100 + xi[0] + noise(generator), -50 + xi[1] + noise(generator), noise(generator));
      }
      const Vector2d at(0.21 + noise(generator), 0.33 + noise(generator));
      const FacetShape shape = facet_shape(type, at);
      Vector3d foot = Vector3d::Zero();
      for (std::size_t i = 0; i < points.size(); ++i) foot += shape.values[i] * points[i];
      const auto projection = project(foot + 0.2 * facet_normal(type, points, at), type, points);
      REQUIRE(projection);
      CHECK((projection->xi - at).norm() < place_accuracy);
      CHECK(projection->distance == Approx(0.2).epsilon(1e-10));
    }
  }
}

TEST_CASE("Along a direction a point meets a facet where the line through it does") {
  const std::vector<Vector3d> segment = {{0, 0, 0}, {4, 0, 0}};
  const auto slanted = project_along({1, 1, 0}, {0, -2, 0}, CellType::seg2, segment);
  REQUIRE(slanted);
  CHECK((slanted->foot - Vector3d(2, 0, 0)).norm() < 1e-13);
  CHECK(slanted->distance == exactly(2 * std::sqrt(2.0)));
  CHECK(slanted->outside == 0.0);
  // A line that passes the facet by ends at its border; one along it meets it nowhere.
  CHECK((project_along({1, 1, 0}, {3, -2, 0}, CellType::seg2, segment)->foot - Vector3d(4, 0, 0)).norm() == 0.0);
  CHECK_FALSE(project_along({1, 0, 0}, {1, -2, 0}, CellType::seg2, segment));

  const std::vector<Vector3d> warped = {{0, 0, 0}, {2, 0, 0.2}, {2, 2, -0.1}, {0, 2, 0.3}};
  const Vector3d direction(0.3, -0.2, 1.0);
  const Vector3d inside = 0.25 * 0.75 * (warped[0] + warped[2]) + 0.75 * 0.75 * warped[1] + 0.25 * 0.25 * warped[3];
  const auto found = project_along(direction, inside + 1.7 * direction, CellType::quad4, warped);
  REQUIRE(found);
  CHECK((found->foot - inside).norm() < place_accuracy);
}

TEST_CASE("Newton's method on the distance stops a ten-thousandth of the place before the foot, and may end farthest") {
  const std::vector<Vector3d> shallow = {{-1, 0, 0}, {1, 0, 0}, {0, -0.2, 0}};
  const auto beside = project({0.9, -1, 0}, CellType::seg3, shallow);
  REQUIRE(beside);
  CHECK(std::abs(beside->from[0] - beside->xi[0]) == Approx(3.569e-5).epsilon(1e-3));
  // A steep arc seen from its inner side: from the middle Newton's method goes to the place that is farthest, outside.
  const std::vector<Vector3d> steep = {{-0.0169, 32.9268, 0}, {0.08997, 32.1410, 0}, {0.0473, 32.3782, 0}};
  const auto farthest = project({1.30885, 33.53618, 0}, CellType::seg3, steep);
  REQUIRE(farthest);
  CHECK(farthest->outside == Approx(0.18423).epsilon(1e-4));
  CHECK(farthest->xi[0] == 1.0);
}
