#include "solver/mesh/joining.hpp"

#include <array>
#include <numeric>
#include <set>

#include <catch2/catch.hpp>

#include "solver/error.hpp"

using namespace comma::solver;

namespace joining_test {

/// A unit square from x on, its left and right sides as groups LEFT and RIGHT, itself as BODY.
Mesh square(double x) {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}};
  mesh.add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  mesh.add_cell(CellType::seg2, std::array{1, 2});
  mesh.add_cell(CellType::seg2, std::array{3, 0});
  mesh.cell_groups = {{"BODY", {0}}, {"RIGHT", {1}}, {"LEFT", {2}}};
  mesh.node_groups = {{"CORNER", {0}}};
  mesh.node_names = {"A", "B", "C", "D"};
  return mesh;
}

TEST_CASE("superposed meshes share nothing, and groups of the same name stay apart", "[mesh]") {
  const JoinedMesh joined = superposed(square(0.0), square(1.0));
  CHECK(joined.mesh.node_count() == 8);
  CHECK(joined.mesh.cell_count() == 6);
  CHECK(joined.mesh.cell_group("BODY") == std::vector<int>{0});
  CHECK(joined.mesh.cell_group("BODY_2") == std::vector<int>{3});
  CHECK(joined.mesh.node_group("CORNER_2") == std::vector<int>{4});
  CHECK(joined.renamed.size() == 4);
  CHECK(joined.mesh.node_name(4) == "N5");
}

TEST_CASE("glued meshes share the nodes of the seam, where the cells of the first go", "[mesh]") {
  const Mesh first = square(0.0);
  Mesh second = square(1.0);
  second.nodes[0][1] = 5e-4;  // within a thousandth of an edge
  const JoinedMesh joined = glued(first, second, first.cell_group("RIGHT"), second.cell_group("LEFT"));
  CHECK(joined.mesh.cell_count() == 5);
  const auto right = joined.mesh.cell(joined.mesh.cell_group("BODY_2").front());
  CHECK(std::vector<int>(right.begin(), right.end()) == std::vector<int>{1, 5, 6, 2});
  const auto seam = joined.mesh.cell(joined.mesh.cell_group("LEFT_2").front());
  CHECK(std::set<int>(seam.begin(), seam.end()) == std::set<int>{1, 2});
  CHECK(joined.mesh.cell_group("RIGHT").size() == 1);  // the second mesh's: the name is free again
  CHECK(joined.mesh.node_group("CORNER_2") == std::vector<int>{1});
}

TEST_CASE("seams across any axis find their partners", "[mesh]") {
  // Sheets of squares in the plane X = 0, whose nodes have one X; the second is numbered the other way round.
  constexpr int side = 20;
  const auto sheet = [](bool reversed) {
    Mesh mesh;
    for (int i = 0; i < side * side; ++i) {
      const int node = reversed ? side * side - 1 - i : i;
      mesh.nodes.push_back({0.0, static_cast<double>(node % side), static_cast<double>(node / side)});
    }
    for (int i = 0; i + side + 1 < side * side; ++i)
      if (i % side != side - 1) mesh.add_cell(CellType::quad4, std::array{i, i + 1, i + side + 1, i + side});
    mesh.cell_groups["ALL"].resize(static_cast<std::size_t>(mesh.cell_count()));
    std::iota(mesh.cell_groups["ALL"].begin(), mesh.cell_groups["ALL"].end(), 0);
    mesh.add_cell(CellType::poi1, std::array{0});
    return mesh;
  };
  const Mesh first = sheet(false), second = sheet(true);
  const JoinedMesh joined = glued(first, second, first.cell_group("ALL"), second.cell_group("ALL"));
  REQUIRE(joined.mesh.cell_count() == second.cell_count() + 1);
  CHECK(joined.mesh.cell(joined.mesh.cell_count() - 1).front() == side * side - 1);
}

TEST_CASE("what does not coincide cannot be glued", "[mesh]") {
  const Mesh first = square(0.0);
  const Mesh second = square(1.1);
  CHECK_THROWS_WITH(glued(first, second, first.cell_group("RIGHT"), second.cell_group("LEFT")),
                    Catch::Contains("node A of the second mesh"));
}

}  // namespace joining_test
