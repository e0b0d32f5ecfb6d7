#include "solver/contact_law/dead_directions.hpp"

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/coupled_points.hpp"

using namespace comma::solver;

namespace {

RowMatrix rows_of(const Eigen::Vector3d& normal, const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  Eigen::Matrix3d rows;
  rows << normal.transpose(), first.transpose(), second.transpose();
  return rows.sparseView();
}

}  // namespace

TEST_CASE("Along a direction in which a point cannot move there is no friction") {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  // The tangents are (3, 4) / 5 and (-4, 3) / 5; the unknown along the second axis is gone, but for rounding.
  std::vector<CondensedPoint> points{point_on_node(0, 3, 0.3)};
  find_dead_directions(rows_of(z, 0.6 * x + 1e-17 * Eigen::Vector3d::UnitY(), -0.8 * x), points);
  CHECK(std::abs(points[0].law.dead.dot(Eigen::Vector2d(0.6, -0.8))) < 1e-12);
  CHECK(std::abs(points[0].law.dead.norm() - 1.0) < 1e-12);
  CHECK(points[0].law.friction == 0.3);

  points = {point_on_node(0, 3, 0.3)};
  find_dead_directions(rows_of(z, 1e-12 * x, -1e-12 * x), points);
  CHECK(points[0].law.friction == 0.0);

  points = {point_on_node(0, 3, 0.3)};
  find_dead_directions(rows_of(z, 0.6 * x, 1e-3 * Eigen::Vector3d::UnitY()), points);
  CHECK(points[0].law.dead.isZero());
}

TEST_CASE("What is left along a dead direction is no slip: a part of the gap of a surface that lies askew") {
  std::vector<CondensedPoint> points{point_on_node(0, 3, 0.3)};
  const Eigen::VectorXd jumps = Eigen::Vector3d(1e-3, 3e-6, 4e-6);
  CHECK(std::abs(slip_of(points[0], jumps) - 5e-6) < 1e-18);
  points[0].law.dead = Eigen::Vector2d(0.0, 1.0);
  CHECK(std::abs(slip_of(points[0], jumps) - 3e-6) < 1e-18);
}

TEST_CASE("Nor is there any where the surface lies askew to the direction in which both bodies are held") {
  // Both are held along z. A surface that a step has tilted by 1e-5 has a tangent that is nearly z, and one that is
  // inclined by 1.
  for (const double tilt : {1e-5, 1.0}) {
    const Eigen::Vector3d normal(0.0, std::cos(tilt), 0.0), tangent(0.0, -std::sin(tilt), 0.0);
    std::vector<CondensedPoint> points{point_on_node(0, 3, 0.3)};
    find_dead_directions(rows_of(normal, Eigen::Vector3d::UnitX(), tangent), points);
    CHECK(std::abs(points[0].law.dead[0]) < 1e-12);
    CHECK(std::abs(points[0].law.dead[1]) == Approx(1.0));
    CHECK(points[0].law.friction == 0.3);
  }
  // Held along x as well, they cannot slip.
  std::vector<CondensedPoint> points{point_on_node(0, 3, 0.3)};
  find_dead_directions(rows_of(Eigen::Vector3d::UnitY(), Eigen::Vector3d::Zero(), 0.5 * Eigen::Vector3d::UnitY()),
                       points);
  CHECK(points[0].law.friction == 0.0);
}

TEST_CASE("In the plane a point on a plane of symmetry has no friction, and one beside it has") {
  const auto friction_of = [](const Eigen::Matrix2d& rows) {
    std::vector<CondensedPoint> points{point_on_node(0, 2, 0.3)};
    find_dead_directions(RowMatrix(rows.sparseView()), points);
    return points[0].law.friction;
  };
  // The unknown along x is gone, but for rounding; the surface lies along it, then inclined to it.
  CHECK(friction_of((Eigen::Matrix2d() << 0.0, 1.0, 1e-17, 0.0).finished()) == 0.0);
  CHECK(friction_of((Eigen::Matrix2d() << 0.0, 0.8, 0.0, -0.6).finished()) == 0.0);
  CHECK(friction_of((Eigen::Matrix2d() << 0.0, 1.0, 1e-3, 0.0).finished()) == 0.3);
}

TEST_CASE("Nodes that are left out of friction are so along the given direction alone, and no others are") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  mesh.add_cell(CellType::tria3, std::vector<int>{0, 1, 2});
  MixedZone zone;
  zone.frictionless_nodes = {1};
  ContactPoint at_it, elsewhere, between;
  at_it.cell = elsewhere.cell = between.cell = 0;
  at_it.node = 1;
  elsewhere.node = 2;
  CHECK(excluded_direction(zone, at_it, mesh)->isZero());
  CHECK_FALSE(excluded_direction(zone, elsewhere, mesh));
  CHECK_FALSE(excluded_direction(zone, between, mesh));
  zone.frictionless_direction = {0, 2, 0};
  CHECK(*excluded_direction(zone, at_it, mesh) == Eigen::Vector3d(0, 2, 0));
  CHECK_FALSE(excluded_direction(zone, elsewhere, mesh));
}

TEST_CASE("A point between nodes is without friction along the direction where the nodes nearest to it are") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  mesh.add_cell(CellType::tria3, std::vector<int>{0, 1, 2});
  MixedZone zone;
  zone.frictionless_nodes = {1};
  zone.frictionless_direction = {0, 2, 0};
  const auto excluded_at = [&](double first, double second, double third) {
    ContactPoint point;
    point.cell = 0;
    point.shape = {first, second, third};
    return excluded_direction(zone, point, mesh);
  };
  CHECK(excluded_at(0.2, 0.6, 0.2) == Eigen::Vector3d(0, 2, 0));
  CHECK_FALSE(excluded_at(0.6, 0.2, 0.2));
  CHECK_FALSE(excluded_at(0.5, 0.5, 0.0));
  zone.frictionless_nodes = {0, 1};
  CHECK(excluded_at(0.5, 0.5, 0.0) == Eigen::Vector3d(0, 2, 0));
}

TEST_CASE("Of a direction without friction its part along the surface counts, and there has to be one") {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  CHECK((along_tangents({3, 4, -7}, x, y, "F1") - Eigen::Vector2d(0.6, 0.8)).norm() < 1e-15);
  CHECK((along_tangents({3, 4, -7}, y, -x, "F1") - Eigen::Vector2d(0.8, -0.6)).norm() < 1e-15);
  CHECK_THROWS_WITH(along_tangents({0, 0, 1}, x, y, "F1"), Catch::Contains("F1"));
}

TEST_CASE(
    "Where both bodies are held along what friction is left, it moves nothing; else the excluded direction stays") {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ(), none = Eigen::Vector3d::Zero();
  const auto with_excluded = [](double first, double second) {
    CondensedPoint point = point_on_node(0, 3, 0.3);
    point.law.dead = Eigen::Vector2d(first, second);
    return std::vector{point};
  };
  // The second tangent is held.
  auto points = with_excluded(1.0, 0.0);
  find_dead_directions(rows_of(z, x, none), points);
  CHECK(points[0].law.friction == 0.0);
  CHECK(points[0].idle_friction == 0.3);
  points = with_excluded(0.0, 1.0);
  find_dead_directions(rows_of(z, x, none), points);
  CHECK(points[0].law.friction == 0.3);
  CHECK(points[0].law.dead == Eigen::Vector2d(0.0, 1.0));
  // What is left lies askew, and moves something.
  points = with_excluded(0.6, 0.8);
  find_dead_directions(rows_of(z, x, none), points);
  CHECK(points[0].law.friction == 0.3);
  CHECK(points[0].law.dead == Eigen::Vector2d(0.6, 0.8));
}

TEST_CASE("A point resists along its normal and along its tangents but for the dead direction") {
  CondensedPoint point = point_on_node(0, 3, 0.3);
  CHECK(resisting_rows(point) == Eigen::Matrix3d::Identity());
  point.law.dead = Eigen::Vector2d(0.6, 0.8);
  CHECK(resisting_rows(point) == (Eigen::MatrixXd(2, 3) << 1, 0, 0, 0, -0.8, 0.6).finished());
  point.law.friction = 0.0;
  CHECK(resisting_rows(point) == (Eigen::MatrixXd(1, 3) << 1, 0, 0).finished());
}
