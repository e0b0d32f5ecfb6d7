#include "solver/constraints/directions.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/constraints/elimination.hpp"
#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::test;

namespace {

const Origin origin = std::make_shared<const std::string>("test");
constexpr double degree = std::numbers::pi / 180.0;

}  // namespace

TEST_CASE("an oblique support holds the node along its direction and lets it slide across") {
  const Model model = nodes_in_a_row(1);
  const DofMap dofs(model);
  const Eigen::Matrix3d axes = nautical_axes(30 * degree, 0.0, 0.0);
  const Elimination elimination(*model.mesh, dofs,
                                applied({along(0, Motion::translation, axes.row(1), -0.015, {}, origin)}));
  CHECK(elimination.reduced_size() == 1);
  const Eigen::Vector2d u = elimination.transformation() * Eigen::VectorXd::Constant(1, 0.7) + elimination.offset(0.0);
  CHECK(-std::sin(30 * degree) * u[0] + std::cos(30 * degree) * u[1] == exactly(-0.015));
}

TEST_CASE("nautical angles: yaw, pitch and roll of U4.42.01") {
  // The trisector of the axes has yaw 45 degrees and pitch -asin(1 / sqrt(3)) (V3.01.104).
  const Eigen::Matrix3d axes = nautical_axes(45 * degree, -std::asin(1 / std::sqrt(3.0)), 0.0);
  CHECK((axes.row(0).transpose() - Eigen::Vector3d::Constant(1 / std::sqrt(3.0))).norm() < 1e-15);
  CHECK(axes(1, 2) == Approx(0.0).margin(1e-15));
  const Eigen::Matrix3d rolled = nautical_axes(0.3, 0.4, 90 * degree);
  CHECK((rolled.row(1) - nautical_axes(0.3, 0.4, 0.0).row(2)).norm() < 1e-15);
  CHECK(rolled.determinant() == exactly(1.0));
}

TEST_CASE("a direction's components that are rounding are left out, so that plane nodes need no DZ") {
  const LinearRelation relation = along(3, Motion::rotation, {1e-17, -2.0, 0.0}, 0.5, {}, origin);
  REQUIRE(relation.terms.size() == 1);
  CHECK(relation.terms[0].component == Component::dry);
  CHECK(relation.terms[0].coefficient == -1.0);
  CHECK_THROWS_AS(along(3, Motion::rotation, {0, 0, 0}, 0.5, {}, origin), Error);
}

TEST_CASE("a beam's axes at its end: x along the cell towards the node, y in the plane of the direction given") {
  Model model;
  model.mesh = std::make_shared<Mesh>();
  model.mesh->nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  model.mesh->add_cell(CellType::seg2, std::vector{0, 1});
  model.mesh->add_cell(CellType::seg2, std::vector{1, 2});
  model.formulations = {Formulation::euler_beam, Formulation::euler_beam};
  CHECK(beam_at_node(model, 2) == 1);
  CHECK(beam_at_node(model, 1, std::vector{0}) == 0);
  CHECK_THROWS_WITH(beam_at_node(model, 1), Catch::Contains("several") && Catch::Contains("N2"));
  CHECK_THROWS_WITH(beam_at_node(model, 2, std::vector{0}), Catch::Contains("no beams"));
  const Eigen::Matrix3d axes = beam_axes(*model.mesh, 1, 2, {3.0, 0.0, 2.0});
  CHECK((axes.row(1) - Eigen::RowVector3d(0, 0, 1)).norm() < 1e-15);
  CHECK((axes.row(2) - Eigen::RowVector3d(0, -1, 0)).norm() < 1e-15);
  const Eigen::Matrix3d other_end = beam_axes(*model.mesh, 1, 1, {3.0, 0.0, 2.0});
  CHECK((other_end.row(0) - Eigen::RowVector3d(-1, 0, 0)).norm() < 1e-15);
  CHECK((other_end.row(1) - axes.row(1)).norm() < 1e-15);
  CHECK((other_end.row(2) + axes.row(2)).norm() < 1e-15);
  CHECK_THROWS_AS(beam_axes(*model.mesh, 1, 2, {1.0, 0.0, 0.0}), Error);
}

TEST_CASE("normals at the nodes of a quadratic circle point outwards; at a corner they are halved") {
  Mesh mesh;
  mesh.dimension = 2;
  const auto at = [](double angle) { return Point{2 * std::cos(angle), 2 * std::sin(angle), 0.0}; };
  for (int k = 0; k <= 8; ++k) mesh.nodes.push_back(at(k * 0.1));
  for (int k = 0; k < 8; k += 2) mesh.add_cell(CellType::seg3, std::vector{k, k + 2, k + 1});
  const auto normals = mean_normals(mesh, std::vector{0, 1, 2, 3});
  REQUIRE(normals.size() == 9);
  for (int k = 0; k <= 8; ++k) {
    const Eigen::Vector3d radial = Eigen::Vector3d(mesh.nodes[k].data()) / 2.0;
    // A parabola through three points of a circle is off by the square of the half angle over two at its ends.
    CHECK((normals.at(k) - radial).norm() < (k == 0 || k == 8 ? 0.1 * 0.1 / 2 : 1e-12));
  }
  CHECK(plane_tangent({1, 0, 0}) == Eigen::Vector3d(0, 1, 0));

  Mesh corner;
  corner.nodes = {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, -1}};
  corner.add_cell(CellType::quad4, std::vector{0, 3, 2, 1});  // normal +Z
  corner.add_cell(CellType::quad4, std::vector{0, 1, 5, 4});  // normal -X
  const auto halved = mean_normals(corner, std::vector{0, 1});
  CHECK((halved.at(0) - Eigen::Vector3d(-1, 0, 1).normalized()).norm() < 1e-15);
  CHECK((halved.at(2) - Eigen::Vector3d(0, 0, 1)).norm() < 1e-15);
  corner.add_cell(CellType::quad4, std::vector{0, 1, 2, 3});  // the first, turned over
  CHECK_THROWS_WITH(mean_normals(corner, std::vector{0, 2}), Catch::Contains("opposite"));
  corner.add_cell(CellType::seg2, std::vector{0, 1});
  CHECK_THROWS_WITH(mean_normals(corner, std::vector{3}), Catch::Contains("M4"));
}

TEST_CASE("edges have their tangent from node to node, and the mean where two meet") {
  Mesh mesh;
  mesh.dimension = 3;
  mesh.nodes = {{0, 0, 0}, {2, 0, 0}, {2, 0, 3}};
  const int first = mesh.add_cell(CellType::seg2, std::vector<int>{0, 1});
  const int second = mesh.add_cell(CellType::seg2, std::vector<int>{1, 2});
  const std::vector<int> edges = {first, second};
  const auto tangents = mean_tangents(mesh, edges);
  CHECK((tangents.at(0) - Eigen::Vector3d::UnitX()).norm() < 1e-15);
  CHECK((tangents.at(1) - Eigen::Vector3d(1, 0, 1).normalized()).norm() < 1e-15);
  const int back = mesh.add_cell(CellType::seg2, std::vector<int>{1, 0});
  const std::vector<int> folded = {first, back};
  CHECK_THROWS_AS(mean_tangents(mesh, folded), Error);
}
