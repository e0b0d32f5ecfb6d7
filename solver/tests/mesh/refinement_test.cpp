#include "solver/mesh/refinement.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "solver/elements/cell_quadrature.hpp"
#include "solver/error.hpp"
#include "solver/mesh/reference_element.hpp"

namespace comma::solver {
namespace {

Mesh one_cell(CellType type) {
  Mesh mesh;
  for (const ReferencePoint& node : reference_nodes(type)) mesh.nodes.push_back({node[0], node[1], node[2]});
  std::vector<int> nodes(mesh.nodes.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  mesh.add_cell(type, nodes);
  mesh.cell_groups["ALL"] = {0};
  return mesh;
}

double size_of(const Mesh& mesh, int cell) {
  CellSamples samples;
  double size = 0.0;
  for (const CellSample& sample : samples.of(mesh.cell_types[cell], CellRole::body)) {
    const CellPoint at = locate(mesh, cell, sample);
    const double measure = at.measure(dimension(mesh.cell_types[cell]));
    CHECK(measure > 0.0);
    if (dimension(mesh.cell_types[cell]) == 3) CHECK(at.tangents.determinant() > 0.0);
    size += sample.weight * measure;
  }
  return size;
}

TEST_CASE("pieces of a cell fill it, none of them turned inside out") {
  using enum CellType;
  const std::pair<CellType, int> counts[] = {{seg2, 2},    {seg3, 2},   {seg4, 2},    {tria3, 4},   {tria6, 4},
                                             {tria7, 4},   {quad4, 4},  {quad8, 4},   {quad9, 4},   {tetra4, 8},
                                             {tetra10, 8}, {penta6, 8}, {penta15, 8}, {penta18, 8}, {hexa8, 8},
                                             {hexa20, 8},  {hexa27, 8}};
  for (const auto& [type, count] : counts) {
    CAPTURE(name_of(type));
    const Mesh mesh = refined(one_cell(type));
    REQUIRE(mesh.cell_count() == count);
    CHECK(mesh.cell_groups.at("ALL").size() == static_cast<std::size_t>(count));
    double size = 0.0;
    for (int cell = 0; cell < count; ++cell) size += size_of(mesh, cell);
    CHECK(size == Approx(reference_measure(type)).epsilon(1e-12));
  }
}

TEST_CASE("cells that share an edge share its middle") {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  mesh.add_cell(CellType::quad4, std::array{1, 4, 5, 2});
  CHECK(refined(mesh).node_count() == 15);
  CHECK(refined(refined(mesh)).node_count() == 45);
}

// A parabola is what shape functions of second order carry exactly.
Point bent(const Point& at) { return {at[0], at[1] + 0.1 * at[0] * at[0], at[2] - 0.2 * at[0] * at[1]}; }

Mesh bent(Mesh mesh) {
  for (Point& node : mesh.nodes) node = bent(node);
  return mesh;
}

TEST_CASE("new nodes of a curved line or face lie where its shape functions put them") {
  for (const CellType type : {CellType::seg3, CellType::tria6, CellType::quad8}) {
    CAPTURE(name_of(type));
    const Mesh straight = refined(refined(one_cell(type))), curved = refined(refined(bent(one_cell(type))));
    REQUIRE(curved.node_count() == straight.node_count());
    for (int node = 0; node < curved.node_count(); ++node)
      for (std::size_t j = 0; j < 3; ++j)
        CHECK(curved.nodes[node][j] == Approx(bent(straight.nodes[node])[j]).margin(1e-14));
  }
}

TEST_CASE("so do those on the surface and at the corners of the pieces of a solid, whose edges within are straight") {
  const Mesh straight = refined(one_cell(CellType::hexa20)), curved = refined(bent(one_cell(CellType::hexa20)));
  const auto at = [&](const Point& place) {
    return Eigen::Vector3d(curved.nodes[std::ranges::find(straight.nodes, place) - straight.nodes.begin()].data());
  };
  const auto expected = [](const Point& place) { return Eigen::Vector3d(bent(place).data()); };
  for (const Point& place : {Point{1, 0.5, 0}, Point{-0.5, -1, 0}, Point{0, 0, 0}})
    CHECK((at(place) - expected(place)).norm() < 1e-14);
  CHECK((at({0.5, 0, 0}) - 0.5 * (expected({0, 0, 0}) + expected({1, 0, 0}))).norm() < 1e-14);
}

// Two cubes with a face in common: 5 nodes along it in each direction and 3 across where they are cut in two.
TEST_CASE("cells of second order that share a face share its nodes") {
  Mesh mesh = one_cell(CellType::hexa20);
  std::vector<int> second;
  for (const Point& node : std::vector<Point>(mesh.nodes)) {
    const Point at = {node[0] + 2.0, node[1], node[2]};
    const auto found = std::ranges::find(mesh.nodes, at);
    second.push_back(static_cast<int>(found - mesh.nodes.begin()));
    if (found == mesh.nodes.end()) mesh.nodes.push_back(at);
  }
  mesh.add_cell(CellType::hexa20, second);
  REQUIRE(mesh.node_count() == 32);
  CHECK(refined(mesh).node_count() == 81 + 81 - 21);
}

TEST_CASE("pyramids are not cut into smaller ones") {
  CHECK_THROWS_AS(refined(one_cell(CellType::pyram5)), Error);
  CHECK_THROWS_AS(refined(one_cell(CellType::pyram13)), Error);
}

}  // namespace
}  // namespace comma::solver
