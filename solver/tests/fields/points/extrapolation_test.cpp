#include <cmath>

#include <catch2/catch.hpp>

#include "solver/elements/quadrature.hpp"
#include "solver/error.hpp"
#include "solver/fields/points/extrapolation.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace extrapolation_test {

double linear(const ReferencePoint& at) { return 3.0 + 2.0 * at[0] - 1.5 * at[1] + 0.7 * at[2]; }

/// Values of a function at the points of a family, and what the smoothing makes of them at the nodes.
template <class F>
Eigen::VectorXd smoothed(CellType type, std::string_view family, F&& f) {
  const Quadrature points = quadrature(type, family);
  Eigen::VectorXd values(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) values[static_cast<Eigen::Index>(i)] = f(points[i].at);
  return gauss_to_nodes(type, family) * values;
}

std::vector<CellType> all_types() {
  std::vector<CellType> types(std::begin(plane_types), std::end(plane_types));
  types.insert(types.end(), std::begin(solid_types), std::end(solid_types));
  return types;
}

TEST_CASE("smoothing reproduces linear fields at all nodes of every cell with several points", "[fields]") {
  for (const CellType type : all_types()) {
    CAPTURE(name_of(type));
    const auto family = stiffness_family(type, dimension(type) == 3 ? Formulation::solid : Formulation::plane_strain);
    if (quadrature(type, family).size() == 1) continue;
    const auto nodes = reference_nodes(type);
    const Eigen::VectorXd values = smoothed(type, family, linear);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      CHECK(values[static_cast<Eigen::Index>(a)] == exactly(linear(nodes[a])));
  }
}

TEST_CASE("a single point gives its value to all nodes", "[fields]") {
  CHECK(gauss_to_nodes(CellType::tetra4, "FPG1") == Eigen::MatrixXd::Ones(4, 1));
}

TEST_CASE("a node in the middle of an edge has the mean of its ends, whatever the field", "[fields]") {
  const Eigen::VectorXd values =
      smoothed(CellType::quad8, "FPG9", [](const auto& at) { return std::exp(at[0]) * std::cos(2 * at[1]); });
  for (int edge = 0; edge < 4; ++edge)
    CHECK(values[4 + edge] == exactly(0.5 * (values[edge] + values[(edge + 1) % 4])));
}

TEST_CASE("smoothing four points of a quadrangle is exact on bilinear fields", "[fields]") {
  const Eigen::VectorXd values = smoothed(CellType::quad4, "FPG4", [](const auto& at) { return at[0] * at[1]; });
  CHECK(values[0] == exactly(1.0));
  CHECK(values[1] == exactly(-1.0));
}

TEST_CASE("smoothing is least squares: a constant keeps its value and noise its mean", "[fields]") {
  for (const CellType type : all_types()) {
    CAPTURE(name_of(type));
    const auto family = stiffness_family(type, dimension(type) == 3 ? Formulation::solid : Formulation::plane_strain);
    const Eigen::MatrixXd matrix = gauss_to_nodes(type, family);
    CHECK((matrix.rowwise().sum() - Eigen::VectorXd::Ones(matrix.rows())).cwiseAbs().maxCoeff() < 1e-13);
  }
}

TEST_CASE("stresses of a linear displacement are the same at points, element nodes and nodes", "[fields]") {
  const Body body(single_cell(CellType::hexa20, 0.03), Formulation::solid, elastic(2e11, 0.3));
  const auto u = body.displacements(
      [](const Point& x, int k) { return 1e-3 * (k == 0 ? x[0] + 0.4 * x[1] : 0.2 * x[2] - 0.3 * x[k]); });
  const ElementField stress = body.assembler->stresses(u);
  const ElementField at_nodes = to_element_nodes(body.model, continuum_stresses(stress));
  const NodalField mean = nodal_means(*body.model.mesh, at_nodes);
  REQUIRE(at_nodes.points(0) == 20);
  for (int c = 0; c < 6; ++c) {
    for (int node = 0; node < 20; ++node) CHECK(mean.at(node, c) == Approx(stress.at(0, 0, c)).margin(1e-4));
  }
}

TEST_CASE("nodal values are the arithmetic mean over the cells that count", "[fields]") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  for (int i = 0; i < 3; ++i) mesh.add_cell(CellType::seg2, std::array{i, i + 1});
  const ElementField field{"SIEF_R", Support::element_node, {"N", "VY"}, {0, 2, 4, 4}, {1, absent, 2, 5, 4, 7, 6, 8}};
  const NodalField all = nodal_means(mesh, field);
  CHECK(all.at(0, 0) == 1);
  CHECK(all.at(1, 0) == 3);
  CHECK(all.at(1, 1) == 6);  // the first cell's 5 and the second's 7
  CHECK(std::isnan(all.at(0, 1)));
  CHECK(std::isnan(all.at(3, 0)));
  const std::array only = {1};
  CHECK(nodal_means(mesh, field, only).at(1, 0) == 4);
}

TEST_CASE("means leave out cells with several values a point, and carry nothing at their nodes", "[fields]") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  for (int i = 0; i < 3; ++i) mesh.add_cell(CellType::seg2, std::array{i, i + 1});
  // Two layers on the last cell, which has the third node in common with the second.
  const ElementField field{"SIEF_R",     Support::element_node,        {"SIXX"},
                           {0, 2, 4, 8}, {1, 2, 4, 6, 10, 11, 12, 13}, {1, 1, 2}};
  CHECK(layered_cells(field) == std::vector{2});
  const NodalField means = single_valued_means(mesh, field);
  CHECK(means.at(0, 0) == 1);
  CHECK(means.at(1, 0) == 3);
  CHECK(std::isnan(means.at(2, 0)));
  CHECK(std::isnan(means.at(3, 0)));
  CHECK(single_valued_means(mesh, field, std::array{0, 1}).at(2, 0) == 6);
  CHECK_THROWS_WITH(single_valued_means(mesh, field, std::array{2}), Catch::Contains("M3"));
}

TEST_CASE("a field with other points than the element's is refused by the name of the cell", "[fields]") {
  const Body body(single_cell(CellType::quad8), Formulation::plane_strain, elastic(1, 0.3));
  const ElementField field{"SIEF_R", Support::gauss_point, {"SIXX"}, {0, 3}, {1, 2, 3}};
  CHECK_THROWS_WITH(to_element_nodes(body.model, field), Catch::Contains("M1"));
}

}  // namespace extrapolation_test
