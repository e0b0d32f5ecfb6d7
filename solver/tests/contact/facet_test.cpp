#include "solver/contact/facet.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

const std::vector<CellType> facet_types = {CellType::seg2,  CellType::seg3,  CellType::tria3, CellType::tria6,
                                           CellType::tria7, CellType::quad4, CellType::quad8, CellType::quad9};

}  // namespace

TEST_CASE("Facet shape functions are one at their node and sum to one") {
  for (const CellType type : facet_types) {
    INFO(name_of(type));
    for (int i = 0; i < node_count(type); ++i) {
      const FacetShape shape = facet_shape(type, facet_node(type, i));
      for (int j = 0; j < node_count(type); ++j) CHECK(shape.values[j] == Approx(i == j ? 1.0 : 0.0).margin(1e-14));
    }
    const FacetShape shape = facet_shape(type, {0.2, 0.3});
    double total = 0.0;
    Vector2d slope = Vector2d::Zero();
    for (int j = 0; j < node_count(type); ++j) {
      total += shape.values[j];
      slope += shape.gradients[j];
    }
    CHECK(total == Approx(1.0).epsilon(1e-14));
    CHECK(slope.norm() < 1e-14);
  }
}

TEST_CASE("Facet gradients agree with differences of the values") {
  const double h = 1e-6;
  for (const CellType type : facet_types) {
    const Vector2d at(0.17, 0.31);
    const FacetShape shape = facet_shape(type, at);
    for (int axis = 0; axis < dimension(type); ++axis) {
      const FacetShape after = facet_shape(type, at + h * Vector2d::Unit(axis));
      const FacetShape before = facet_shape(type, at - h * Vector2d::Unit(axis));
      // Central differences: h^2 times third derivatives of order 50, and 1e-16 / h of rounding.
      for (int j = 0; j < node_count(type); ++j)
        CHECK((after.values[j] - before.values[j]) / (2 * h) == Approx(shape.gradients[j][axis]).margin(1e-9));
    }
  }
}

TEST_CASE("What falls outside a reference cell is measured and brought back to its border") {
  CHECK(outside_distance(CellType::seg2, {1.17, 0}) == exactly(0.17));
  CHECK(bring_back(CellType::seg3, {-3, 0}) == Vector2d(-1, 0));
  CHECK(bring_back(CellType::quad4, {1.5, -2}) == Vector2d(1, -1));
  CHECK((bring_back(CellType::tria3, {1, 1}) - Vector2d(0.5, 0.5)).norm() < 1e-15);
  CHECK(bring_back(CellType::tria3, {3, -1}) == Vector2d(1, 0));
  CHECK(bring_back(CellType::tria6, {-0.5, 0.4}) == Vector2d(0, 0.4));
}

TEST_CASE("Wherever a point lies beside a triangle, it is brought back to the nearest place inside") {
  for (double x = -1.5; x <= 2.5; x += 0.125) {
    for (double y = -1.5; y <= 2.5; y += 0.125) {
      const Vector2d xi(x, y);
      const Vector2d place = bring_back(CellType::tria3, xi);
      CHECK(outside_distance(CellType::tria3, place) <= 1e-15);
      double nearest = 1e300;
      for (double first = 0.0; first <= 1.0; first += 0.03125)
        for (double second = 0.0; first + second <= 1.0; second += 0.03125)
          nearest = std::min(nearest, (Vector2d(first, second) - xi).norm());
      CHECK((place - xi).norm() <= nearest + 1e-15);
    }
  }
  // Beyond a corner, on the inner side of the slanted edge's line.
  CHECK(bring_back(CellType::tria3, {1.25, -0.5}) == Vector2d(1, 0));
  CHECK(bring_back(CellType::tria3, {-0.5, 1.25}) == Vector2d(0, 1));
}

TEST_CASE("How far a point lies outside is its distance, beside corners and slanted edges too") {
  CHECK(outside_distance(CellType::quad4, {1.08, -1.06}) == exactly(0.1));
  CHECK(outside_distance(CellType::tria3, {-0.08, -0.06}) == exactly(0.1));
  CHECK(outside_distance(CellType::tria3, {0.6, 0.5}) == exactly(0.1 / std::sqrt(2.0)));
  CHECK(outside_distance(CellType::tria3, {1.03, -0.04}) == exactly(0.05));
}

TEST_CASE("Normals of edges that go round counter-clockwise, and of faces, point out") {
  const std::vector<Vector3d> bottom = {{0, 0, 0}, {2, 0, 0}};
  CHECK((facet_normal(CellType::seg2, bottom, {0, 0}) - Vector3d(0, -1, 0)).norm() < 1e-15);
  const std::vector<Vector3d> top = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  CHECK((facet_normal(CellType::quad4, top, {0.3, 0.2}) - Vector3d(0, 0, 1)).norm() < 1e-15);
}

TEST_CASE("A facet without a normal, and a cell that is no facet, are errors") {
  const std::vector<Vector3d> point = {{1, 1, 0}, {1, 1, 0}};
  CHECK_THROWS_AS(facet_normal(CellType::seg2, point, {0, 0}), Error);
  CHECK_THROWS_AS(facet_shape(CellType::hexa8, {0, 0}), Error);
}
