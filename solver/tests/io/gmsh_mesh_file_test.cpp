#include "solver/io/gmsh_mesh_file.hpp"

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/mesh/reference_cell.hpp"

using namespace comma::solver;
using Group = std::vector<int>;

namespace {

// A square of two triangles with its lower edge, in each version of the format. Numbers begin at 5 and skip 7.
const std::string version_1 = R"($NOD
4
5 0 0 0
6 1 0 0
8 1 1 0
9 0 1 0
$ENDNOD
$ELM
3
1 1 20 1 2 5 6
2 2 10 1 3 5 6 8
4 2 10 1 3 5 8 9
$ENDELM
)";
const std::string version_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 20 "Lower edge"
2 10 "PLATE"
$EndPhysicalNames
$Comments
anything at all
$EndComments
$Nodes
4
5 0 0 0
6 1 0 0
8 1 1 0
9 0 1 0
$EndNodes
$Elements
3
1 1 2 20 1 5 6
2 2 2 10 1 5 6 8
4 2 2 10 1 5 8 9
$EndElements
)";
const std::string version_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 20 "Lower edge"
2 10 "PLATE"
$EndPhysicalNames
$Entities
1 1 1 0
1 0 0 0 0
7 0 0 0 1 0 0 1 20 1 1
3 0 0 0 1 1 0 1 10 1 7
$EndEntities
$Nodes
1 4 5 9
2 3 0 4
5
6
8
9
0 0 0
1 0 0
1 1 0
0 1 0
$EndNodes
$Elements
2 3 1 4
1 7 1 1
1 5 6
2 3 2 2
2 5 6 8
4 5 8 9
$EndElements
)";

std::string code_of(const std::string& text) {
  try {
    parse_gmsh_mesh(text, "plate.msh");
  } catch (const Error& error) {
    return error.code();
  }
  return "none";
}

/// The nodes of one cell as Gmsh lists them, given the edges between whose corners its mid-edge nodes lie.
std::string single_cell(int number, CellType type, const std::vector<std::array<int, 2>>& edges) {
  const auto points = reference_points(type);
  const int corners = corner_count(type);
  std::string nodes;
  std::string names;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Point at = points[i];
    if (i >= static_cast<std::size_t>(corners)) {
      const auto [a, b] = edges[i - static_cast<std::size_t>(corners)];
      for (int axis = 0; axis < 3; ++axis) at[axis] = (points[a][axis] + points[b][axis]) / 2;
    }
    nodes += fmt::format("{} {} {} {}\n", i + 1, at[0], at[1], at[2]);
    names += fmt::format(" {}", i + 1);
  }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n{}$EndNodes\n$Elements\n1\n1 {} 2 1 1{}\n$EndElements\n",
      points.size(), nodes, number, names);
}

}  // namespace

TEST_CASE("the same mesh comes out of every version of the format", "[io]") {
  for (const std::string& text : {version_1, version_2, version_4}) {
    const Mesh mesh = parse_gmsh_mesh(text, "plate.msh");
    CHECK(mesh.dimension == 2);
    CHECK(mesh.nodes == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(mesh.node_name(2) == "N3");
    CHECK(mesh.cell_name(2) == "M3");
    CHECK(mesh.connectivity == Group{0, 1, 0, 1, 2, 0, 2, 3});
    CHECK(mesh.cell_group("GM20") == Group{0});
    CHECK(mesh.cell_group("GM10") == Group{1, 2});
  }
  for (const std::string& text : {version_2, version_4}) {
    CHECK(parse_gmsh_mesh(text, "plate.msh").cell_group("Lower edge") == Group{0});
    CHECK(parse_gmsh_mesh(text, "plate.msh").cell_group("PLATE") == Group{1, 2});
  }
}

TEST_CASE("cells of Gmsh stand type by type, and nodes that no cell has are left out", "[io]") {
  const Mesh mesh = parse_gmsh_mesh(R"($NOD
6
9 0 0 0
7 5 5 0
3 1 0 0
4 1 1 0
12 0 1 0
5 2 0.5 0
$ENDNOD
$ELM
4
8 3 10 1 4 9 3 4 12
2 15 0 1 1 9
3 2 10 1 3 3 5 4
5 1 20 1 2 9 3
$ENDELM
)",
                                    "plate.msh");
  CHECK(mesh.nodes == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, 0}});
  CHECK(mesh.cell_types == std::vector<CellType>{CellType::seg2, CellType::tria3, CellType::quad4, CellType::poi1});
  CHECK(mesh.connectivity == Group{0, 1, 1, 4, 2, 0, 1, 2, 3, 0});
  CHECK(mesh.cell_group("GM10") == Group{2, 1});
  CHECK(mesh.cell_group("GM20") == Group{0});
  CHECK(mesh.cell_group("GM0") == Group{3});
}

TEST_CASE("quadratic cells of Gmsh get Code_Aster's order of nodes", "[io]") {
  // The edges are Gmsh's own (reference manual, "Node ordering").
  const std::string hexa =
      single_cell(17, CellType::hexa20,
                  {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}});
  const std::string tetra = single_cell(11, CellType::tetra10, {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}});
  const std::string penta =
      single_cell(18, CellType::penta15, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}});
  const std::string pyram =
      single_cell(19, CellType::pyram13, {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}});
  for (const std::string& text : {hexa, tetra, penta, pyram}) {
    const Mesh mesh = parse_gmsh_mesh(text, "cell.msh");
    CAPTURE(name_of(mesh.cell_types[0]));
    CHECK(mesh.dimension == 3);
    const auto expected = reference_points(mesh.cell_types[0]);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Point& node = mesh.nodes[static_cast<std::size_t>(mesh.cell(0)[i])];
      for (int axis = 0; axis < 3; ++axis) CHECK(node[axis] == Approx(expected[i][axis]).margin(1e-15));
    }
  }
}

TEST_CASE("the node inside a QUAD9 of Gmsh is left out, those inside HEXA27 and PENTA18 are kept", "[io]") {
  // The edges are Gmsh's own; the inner nodes of this file lie elsewhere.
  const std::vector<std::array<int, 2>> square = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}};
  const std::vector<std::array<int, 2>> wedge = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5},
                                                 {3, 4}, {3, 5}, {4, 5}, {0, 4}, {0, 5}, {1, 5}};
  std::vector<std::array<int, 2>> cube = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                                          {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
  cube.resize(19, {0, 6});
  struct Read {
    std::string text;
    CellType type, first_nodes;
  };
  const std::array<Read, 3> cells = {{{single_cell(10, CellType::quad9, square), CellType::quad8, CellType::quad8},
                                      {single_cell(13, CellType::penta18, wedge), CellType::penta18, CellType::penta15},
                                      {single_cell(12, CellType::hexa27, cube), CellType::hexa27, CellType::hexa20}}};
  for (const auto& [text, type, first_nodes] : cells) {
    const Mesh mesh = parse_gmsh_mesh(text, "cell.msh");
    REQUIRE(mesh.cell_types[0] == type);
    CHECK(mesh.node_count() == node_count(type));
    const auto expected = reference_points(first_nodes);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Point& node = mesh.nodes[static_cast<std::size_t>(mesh.cell(0)[i])];
      for (int axis = 0; axis < 3; ++axis) CHECK(node[axis] == Approx(expected[i][axis]).margin(1e-15));
    }
  }
}

TEST_CASE("a damaged Gmsh file is an error with its place", "[io]") {
  for (const std::string& text : {version_1, version_2, version_4}) {
    // Cut off anywhere before its last section has ended, a file is not taken for a whole one.
    for (std::size_t length = 0; length + 1 < text.size(); length += 3) {
      const std::string code = code_of(text.substr(0, length));
      const bool between_sections = code == "none";
      CAPTURE(length);
      CHECK((code == "damaged-mesh" || code == "unsupported" || between_sections));
      if (between_sections) CHECK(text.substr(0, length).find("$E") != std::string::npos);
    }
  }
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  CHECK_THROWS_WITH(parse_gmsh_mesh(with(version_2, "2 2 2 10 1 5 6 8", "2 2 2 10 1 5 6 7"), "plate.msh"),
                    Catch::Contains("plate.msh:22:16: cell 2 has the node 7, which is not in the file"));
  CHECK_THROWS_WITH(parse_gmsh_mesh(with(version_2, "9 0 1 0", "8 0 1 0"), "plate.msh"),
                    Catch::Contains("node 8 stands twice"));
  CHECK_THROWS_WITH(parse_gmsh_mesh(with(version_2, "1 1 0", "1 x 0"), "plate.msh"),
                    Catch::Contains("a coordinate should stand here, not x"));
  CHECK(code_of(with(version_2, "2.2 0 8", "2.2 1 8")) == "unsupported");
  CHECK(code_of(with(version_2, "2.2 0 8", "3.0 0 8")) == "unsupported");
  CHECK(code_of(with(version_2, "2 2 2 10 1 5 6 8", "2 92 2 10 1 5 6 8")) == "unsupported-cell");
  CHECK(code_of("not a mesh") == "damaged-mesh");
  CHECK_THROWS_WITH(read_gmsh_mesh("/nowhere/at/all.msh"), Catch::Contains("cannot read"));
  CHECK_THROWS_WITH(read_gmsh_mesh("/dev/zero"), Catch::Contains("is not a regular file"));
}
