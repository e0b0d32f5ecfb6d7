#include "solver/mesh/mesh.hpp"

#include <catch2/catch.hpp>

#include "solver/error.hpp"

using namespace comma::solver;

namespace {

Mesh two_quads() {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  mesh.add_cell(CellType::quad4, std::vector{0, 1, 4, 3});
  mesh.add_cell(CellType::quad4, std::vector{1, 2, 5, 4});
  mesh.cell_groups["LEFT"] = {0};
  mesh.node_groups["CORNER"] = {2};
  return mesh;
}

}  // namespace

TEST_CASE("cells keep their nodes and count up") {
  const Mesh mesh = two_quads();
  REQUIRE(mesh.cell_count() == 2);
  CHECK(std::vector(mesh.cell(1).begin(), mesh.cell(1).end()) == std::vector{1, 2, 5, 4});
  CHECK(mesh.nodes_of_cells(std::vector{1, 0}) == std::vector{0, 1, 2, 3, 4, 5});
  CHECK(mesh.nodes_of_cells({}).empty());
}

TEST_CASE("nameless nodes and cells are called N1, M1 and so on") {
  const Mesh mesh = two_quads();
  CHECK(mesh.node_name(0) == "N1");
  CHECK(mesh.cell_name(1) == "M2");
  CHECK(mesh.find_node("N6") == 5);
  CHECK(mesh.find_node("6") == 5);
  for (const char* wrong : {"N7", "N0", "N01", "N", "M1", "N1x", "", "N-1", "N99999999999999"}) {
    INFO(wrong);
    CHECK(mesh.find_node(wrong) == -1);
  }
}

TEST_CASE("names of their own replace the default ones") {
  Mesh mesh = two_quads();
  mesh.cell_names = {"QA", "QB"};
  CHECK(mesh.cell_name(1) == "QB");
  CHECK(mesh.find_cell("QB") == 1);
  CHECK(mesh.find_cell("M1") == -1);
}

TEST_CASE("an unknown group is an error that names the nearest one") {
  const Mesh mesh = two_quads();
  CHECK(mesh.cell_group("LEFT") == std::vector{0});
  const auto hint_for = [&](const char* name) -> std::string {
    try {
      mesh.cell_group(name);
    } catch (const Error& error) {
      CHECK(error.code() == "unknown-group");
      return error.hint();
    }
    return "no error";
  };
  CHECK(hint_for("LEFTT") == "did you mean LEFT?");
  CHECK(hint_for("CORNER") == "CORNER is a node group of this mesh");
  CHECK(hint_for("ZZZZZZ") == "its cell groups are LEFT");
}
