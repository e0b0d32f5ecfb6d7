#include "solver/mesh/boundary.hpp"

#include <catch2/catch.hpp>

#include "reference_cells.hpp"

using namespace comma::solver;

TEST_CASE("signed sizes are those of the reference cells, and change sign when the cell is mirrored") {
  Mesh mesh = tests::mesh_of_reference_cells();
  Mesh mirrored = mesh;
  for (Point& point : mirrored.nodes) point[0] = -point[0];
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const CellType type = mesh.cell_types[cell];
    INFO(name_of(type));
    const double expected = dimension(type) < 2 ? 0.0 : tests::reference_volume(type);
    CHECK(signed_size(mesh, cell) == Approx(expected).epsilon(1e-14));
    CHECK(signed_size(mirrored, cell) == Approx(-expected).epsilon(1e-14));
  }
}

TEST_CASE("the boundary of two neighbours leaves out what they share") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_cell(CellType::tria3, std::vector{0, 1, 2});
  mesh.add_cell(CellType::tria3, std::vector{0, 2, 3});
  const auto outline = boundary_of(mesh, std::vector{0, 1});
  REQUIRE(outline.size() == 4);
  CHECK(nodes_of_facet(mesh, outline[0]) == std::vector{0, 1});
  CHECK(nodes_of_facet(mesh, outline[1]) == std::vector{1, 2});
  CHECK(nodes_of_facet(mesh, outline[2]) == std::vector{2, 3});
  CHECK(nodes_of_facet(mesh, outline[3]) == std::vector{3, 0});
  CHECK(boundary_of(mesh, std::vector{0}).size() == 3);
  const int edge = mesh.add_cell(CellType::seg2, std::vector{2, 0});
  const auto facets = map_facets(mesh, std::vector{0, 1});
  REQUIRE(facets.contains(facet_key(mesh, edge)));
  CHECK(facets.at(facet_key(mesh, edge)).size() == 2);
}
