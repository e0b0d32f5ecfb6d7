#include "solver/mesh/refinement.hpp"

#include <array>
#include <numeric>

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
  const std::pair<CellType, int> counts[] = {{CellType::seg2, 2},   {CellType::tria3, 4},  {CellType::quad4, 4},
                                             {CellType::tetra4, 8}, {CellType::penta6, 8}, {CellType::hexa8, 8}};
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

TEST_CASE("pyramids are not cut into smaller ones") { CHECK_THROWS_AS(refined(one_cell(CellType::pyram5)), Error); }

}  // namespace
}  // namespace comma::solver
