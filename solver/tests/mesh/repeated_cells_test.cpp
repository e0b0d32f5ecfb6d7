#include "solver/mesh/repeated_cells.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace repeated_cells_test {

TEST_CASE("Cells of one type on the same nodes are doubles of the first, whatever the order of their nodes") {
  Mesh mesh;
  mesh.nodes.resize(5);
  mesh.add_cell(CellType::quad4, std::vector{0, 1, 2, 3});
  mesh.add_cell(CellType::tetra4, std::vector{0, 1, 2, 3});
  mesh.add_cell(CellType::seg2, std::vector{1, 2});
  mesh.add_cell(CellType::quad4, std::vector{2, 1, 0, 3});
  mesh.add_cell(CellType::seg2, std::vector{2, 3});
  mesh.add_cell(CellType::quad4, std::vector{3, 0, 1, 2});
  mesh.add_cell(CellType::seg2, std::vector{2, 1});
  const std::vector<RepeatedCell> found = repeated_cells(mesh);
  REQUIRE(found.size() == 3);
  CHECK((found[0].first == 0 && found[0].again == 3));
  CHECK((found[1].first == 0 && found[1].again == 5));
  CHECK((found[2].first == 2 && found[2].again == 6));
}

TEST_CASE("Points beside each other are no doubles") {
  Mesh mesh;
  mesh.nodes.resize(1);
  mesh.add_cell(CellType::poi1, std::vector{0});
  mesh.add_cell(CellType::poi1, std::vector{0});
  CHECK(repeated_cells(mesh).empty());
}

}  // namespace repeated_cells_test
