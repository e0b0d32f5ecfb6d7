#include "solver/fields/points/discretisation.hpp"

#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/fields/data/field_room.hpp"
#include "solver/fields/points/continuum_points.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

/// Two quadrangles side by side, one of them skew, with an edge on the left.
Model two_quadrangles() {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1.2, 1, 0}, {2, 1, 0}};
  mesh->add_cell(CellType::quad4, std::array{0, 1, 4, 3});
  mesh->add_cell(CellType::quad4, std::array{1, 2, 5, 4});
  mesh->add_cell(CellType::seg2, std::array{3, 0});
  return {std::move(mesh), std::vector<Formulation>(3, Formulation::plane_strain)};
}

double linear(double x, double y) { return 3.0 + 2.0 * x - 5.0 * y; }

NodalField linear_field(const Mesh& mesh) {
  NodalField field = empty_nodal_field(mesh, "NEUT_R", {"X1"});
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) field.values[i] = linear(mesh.nodes[i][0], mesh.nodes[i][1]);
  return field;
}

}  // namespace

TEST_CASE("a linear field at nodes is the same at Gauss points, those of the skin included, and back", "[fields]") {
  const Model model = two_quadrangles();
  const ElementField at_points = brought_to(model, linear_field(*model.mesh), Support::gauss_point, true);
  ContinuumPoints points(model);
  for (const int cell : {0, 1}) {
    const auto& samples = points.samples(cell);
    REQUIRE(at_points.points(cell) == static_cast<int>(samples.size()));
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Eigen::Vector3d at = points.locate(cell, samples[i]).at;
      CHECK(at_points.at(cell, static_cast<int>(i), 0) == exactly(linear(at[0], at[1])));
    }
  }
  // Points of the edge lie evenly about its middle.
  double sum = 0.0;
  for (int i = 0; i < at_points.points(2); ++i) sum += at_points.at(2, i, 0);
  CHECK(sum / at_points.points(2) == exactly(linear(0.0, 0.5)));
  // The smoothing of the rectangle-like cells is exact on bilinear fields.
  const NodalField back =
      brought_to_nodes(*model.mesh, &model, brought_to(model, linear_field(*model.mesh), Support::gauss_point, false));
  CHECK(back.at(3, 0) == exactly(linear(0.0, 1.0)));
}

TEST_CASE("one value a cell holds all over it, and nodes between cells have the mean", "[fields]") {
  const Model model = two_quadrangles();
  ElementField zones = empty_cell_field(*model.mesh, "TEMP_R", {"TEMP"});
  zones.values = {10.0, 30.0, absent};
  const ElementField at_points = brought_to(model, zones, Support::gauss_point, false);
  CHECK(at_points.at(1, 2, 0) == 30.0);
  const ElementField at_corners = brought_to(model, zones, Support::element_node, false);
  CHECK(at_corners.at(0, 3, 0) == 10.0);
  const NodalField nodal = brought_to_nodes(*model.mesh, nullptr, zones);
  CHECK(nodal.at(0, 0) == 10.0);
  CHECK(nodal.at(1, 0) == 20.0);
  CHECK(nodal.at(2, 0) == 30.0);
}

TEST_CASE("one value a cell is the mean of its nodes or points", "[fields]") {
  const Model model = two_quadrangles();
  const NodalField at_nodes = linear_field(*model.mesh);
  const ElementField of_nodes = brought_to(model, at_nodes, Support::cell, true);
  CHECK(of_nodes.at(0, 0, 0) == exactly(linear(2.2 / 4.0, 0.5)));
  CHECK(of_nodes.at(2, 0, 0) == exactly(linear(0.0, 0.5)));
  const ElementField corners = brought_to(model, at_nodes, Support::element_node, false);
  CHECK(brought_to(model, corners, Support::cell, false).at(1, 0, 0) == exactly(linear(6.2 / 4.0, 0.5)));
  // Points of a quadrangle lie evenly about its middle.
  const ElementField points = brought_to(model, at_nodes, Support::gauss_point, false);
  CHECK(brought_to(model, points, Support::cell, false).at(0, 0, 0) == exactly(linear(2.2 / 4.0, 0.5)));
  NodalField partial = at_nodes;
  partial.values[0] = absent;
  CHECK(std::isnan(brought_to(model, partial, Support::cell, false).at(0, 0, 0)));
  CHECK(brought_to(model, partial, Support::cell, false).at(1, 0, 0) == exactly(linear(6.2 / 4.0, 0.5)));
}

TEST_CASE("what cannot be brought elsewhere says so", "[fields]") {
  const Model model = two_quadrangles();
  const ElementField at_points = brought_to(model, linear_field(*model.mesh), Support::gauss_point, false);
  CHECK_THROWS_WITH(brought_to_nodes(*model.mesh, nullptr, at_points), Catch::Contains("model"));
}

TEST_CASE("what is linear along a beam is so at its three points", "[fields]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}, {2, 0, 0}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  const Model model{mesh, {Formulation::timoshenko_beam}};
  const ElementField places = brought_to(model, node_coordinates(*mesh), Support::gauss_point, true);
  REQUIRE(places.points(0) == 3);
  const double apart = std::sqrt(0.6);
  for (int point = 0; point < 3; ++point) CHECK(places.at(0, point, 0) == exactly(1.0 + (point - 1) * apart));
}
