#include "solver/io/gmsh_writer.hpp"

#include <array>
#include <numeric>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/io/gmsh_cells.hpp"
#include "solver/io/gmsh_mesh_file.hpp"

using namespace comma::solver;

namespace gmsh_writer_test {

/// One cell of each type that Gmsh knows and that is read as it is, each on nodes of its own.
Mesh every_cell() {
  Mesh mesh;
  for (const GmshType& known : gmsh_types()) {
    if (kept_type(known.type) != known.type) continue;
    std::vector<int> nodes(static_cast<std::size_t>(node_count(known.type)));
    std::iota(nodes.begin(), nodes.end(), mesh.node_count());
    for (const int node : nodes)
      mesh.nodes.push_back({0.1 * node, 1.0 / (node + 1.0), static_cast<double>(node * node)});
    mesh.add_cell(known.type, nodes);
  }
  return mesh;
}

std::vector<int> all_cells(const Mesh& mesh) {
  std::vector<int> cells(static_cast<std::size_t>(mesh.cell_count()));
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

Mesh segment_and_triangle() {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.add_cell(CellType::seg2, std::array{0, 1});
  mesh.add_cell(CellType::tria3, std::array{0, 1, 2});
  return mesh;
}

TEST_CASE("a mesh written for Gmsh is read back as it was, whatever its cells", "[io]") {
  const Mesh mesh = every_cell();
  const Mesh back = parse_gmsh_mesh(format_gmsh(mesh, all_cells(mesh), {}), "written.msh");
  REQUIRE(back.node_count() == mesh.node_count());
  CHECK(back.nodes == mesh.nodes);
  CHECK(back.cell_types == mesh.cell_types);
  CHECK(back.connectivity == mesh.connectivity);
}

TEST_CASE("only the cells that are named are written", "[io]") {
  const Mesh mesh = segment_and_triangle();
  CHECK_THAT(format_gmsh(mesh, std::array{1}, {}), Catch::Contains("$Elements\n1\n2 2 2 0 0 1 2 3\n$EndElements\n"));
}

TEST_CASE("views of Gmsh hold the places that carry a value", "[io]") {
  const Mesh mesh = segment_and_triangle();
  const Field nodal = NodalField{"DEPL_R", {"DX", "DY"}, {1, 2, absent, absent, absent, 3}};
  const std::vector<GmshView> vectors = {{"U DEPL", 0.5, 3, &nodal, {0, 1, -1}}};
  CHECK_THAT(format_gmsh(mesh, all_cells(mesh), vectors),
             Catch::Contains("$NodeData\n1\n\"U DEPL\"\n1\n0.5\n3\n3\n3\n2\n1 1 2 0\n3 0 3 0\n$EndNodeData\n"));

  const Field element = ElementField{"SIEF_R", Support::element_node, {"SIXX"}, {0, 0, 3}, {7, 8, 9}};
  const std::vector<GmshView> scalars = {{"S", 0.0, 0, &element, {0}}};
  CHECK_THAT(format_gmsh(mesh, all_cells(mesh), scalars),
             Catch::Contains("$ElementNodeData\n1\n\"S\"\n1\n0\n3\n0\n1\n1\n2 3 7 8 9\n$EndElementNodeData\n"));

  const Field gauss = ElementField{"SIEF_R", Support::gauss_point, {"SIXX"}, {0, 0, 1}, {7}};
  const std::vector<GmshView> refused = {{"S", 0.0, 0, &gauss, {0}}};
  CHECK_THROWS_AS(format_gmsh(mesh, all_cells(mesh), refused), Error);
}

}  // namespace gmsh_writer_test
