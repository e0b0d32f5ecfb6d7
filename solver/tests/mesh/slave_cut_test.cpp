#include "solver/mesh/slave_cut.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "reference_cells.hpp"
#include "solver/error.hpp"
#include "solver/mesh/boundary.hpp"
#include "solver/mesh/conversion.hpp"

using namespace comma::solver;
using comma::solver::tests::solid_volume;

namespace {

/// A reference cell with a cell on each of its facets; cell 0 is the body, facet i is cell i + 1.
Mesh dressed(CellType type) {
  Mesh mesh;
  mesh.nodes = reference_points(type);
  std::vector<int> nodes(mesh.nodes.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  mesh.dimension = dimension(type);
  mesh.add_cell(type, nodes);
  for (int facet = 0; facet < static_cast<int>(boundary_facets(type).size()); ++facet) {
    const auto on_facet = nodes_of_facet(mesh, {0, facet});
    mesh.add_cell(boundary_facets(type)[static_cast<std::size_t>(facet)].type, on_facet);
  }
  return mesh;
}

double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (dimension(mesh.cell_types[cell]) != mesh.dimension) continue;
    CAPTURE(cell, name_of(mesh.cell_types[cell]));
    const double own = mesh.dimension == 3 ? solid_volume(mesh, cell) : signed_size(mesh, cell);
    CHECK(own > 0.0);
    sum += own;
  }
  return sum;
}

/// Whether the skin cells are just the facets that one body alone has.
bool is_closed(const Mesh& mesh) {
  std::vector<int> bodies;
  std::set<FacetKey> skins;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (dimension(mesh.cell_types[cell]) == mesh.dimension) bodies.push_back(cell);
    if (dimension(mesh.cell_types[cell]) == mesh.dimension - 1) skins.insert(facet_key(mesh, cell));
  }
  std::set<FacetKey> outer;
  for (const CellFacet& facet : boundary_of(mesh, bodies)) outer.insert(facet_key(mesh, facet));
  return outer == skins;
}

/// Every quadratic cell has its mid-edge nodes half-way.
bool is_straight(const Mesh& mesh) {
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell(cell);
    const auto edges = middle_edges(mesh.cell_types[cell]);
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (int axis = 0; axis < 3; ++axis) {
        const auto at = [&](int local) {
          return mesh
              .nodes[static_cast<std::size_t>(nodes[static_cast<std::size_t>(local)])][static_cast<std::size_t>(axis)];
        };
        if (std::abs(at(corner_count(mesh.cell_types[cell]) + static_cast<int>(e)) -
                     0.5 * (at(edges[e][0]) + at(edges[e][1]))) > 1e-14)
          return false;
      }
  }
  return true;
}

}  // namespace

TEST_CASE("Cutting a slave face fills the body, and touches none of its other facets", "[mesh]") {
  using enum CellType;
  for (const CellType type : {tria3, quad4, tetra4, pyram5, penta6, hexa8, tetra10, pyram13, penta15, hexa20}) {
    const Mesh whole = dressed(type);
    const double expected = whole.dimension == 3 ? solid_volume(whole, 0) : signed_size(whole, 0);
    for (int face = 1; face < whole.cell_count(); ++face) {
      CAPTURE(name_of(type), face);
      const Mesh mesh = with_cut_slave_faces(whole, std::vector{face}, HexaCut::pyramids);
      CHECK(volume(mesh) == Approx(expected).epsilon(1e-14));
      CHECK(is_closed(mesh));
      CHECK(is_straight(mesh));
      REQUIRE(mesh.slave_patches.size() == 1);
      // The pieces of the body come first, those of the face stand in its place.
      const std::vector<int>& patch = mesh.slave_patches.front();
      const int added = mesh.cell_count() - whole.cell_count();
      const int of_face = static_cast<int>(patch.size()) - 1;
      for (int i = 0; i <= of_face; ++i) CHECK(patch[static_cast<std::size_t>(i)] == added - of_face + face + i);
      for (int other = 1; other < whole.cell_count(); ++other) {
        const int now = other + added - (other < face ? of_face : 0);
        if (other != face) CHECK(std::ranges::equal(mesh.cell(now), whole.cell(other)));
      }
      if (type == quad4) {
        CHECK(mesh.slave_patches.front().size() == 3);
        CHECK(inner_nodes(mesh, mesh.slave_patches.front()).size() == 2);
        continue;
      }
      const std::size_t corners = static_cast<std::size_t>(corner_count(whole.cell_types[face]));
      CHECK(mesh.slave_patches.front().size() == corners);
      CHECK(inner_nodes(mesh, mesh.slave_patches.front()).size() == 1);
    }
  }
}

TEST_CASE("New nodes of quadratic cells are numbered as in Code_Aster 17.3", "[mesh]") {
  using enum CellType;
  for (const CellType type : {tetra10, penta15, hexa20}) {
    const Mesh whole = dressed(type);
    for (int face = 1; face < whole.cell_count(); ++face) {
      if (type == penta15 && whole.cell_types[face] == quad8) continue;
      CAPTURE(name_of(type), face);
      const Mesh mesh = with_cut_slave_faces(whole, std::vector{face}, HexaCut::pyramids);
      const auto at = [&](int node) { return Eigen::Vector3d(mesh.nodes[node].data()); };
      const auto corners = whole.cell(face).first(static_cast<std::size_t>(corner_count(whole.cell_types[face])));
      const int count = static_cast<int>(corners.size());
      const int first = whole.node_count();
      // On triangles the centre comes after what its edges carry, on quadrangles before.
      const int centre = count == 3 ? first + 3 : first;
      CHECK(inner_nodes(mesh, mesh.slave_patches.front()).front() == centre);
      for (int i = 0; i < count; ++i) {
        const int middle = count == 3 ? first + i : first + 1 + i;
        CHECK((at(middle) - (at(centre) + at(corners[static_cast<std::size_t>(i)])) / 2).norm() < 1e-14);
      }
      CHECK(mesh.node_count() == first + (type == tetra10 ? 5 : 1 + 2 * count));
    }
  }
}

TEST_CASE("Pieces of triangles, quadrangles and tetrahedra stand as in Code_Aster 17.3", "[mesh]") {
  using enum CellType;
  using Nodes = std::vector<int>;
  const auto pieces = [](CellType type, int face, int count) {
    const Mesh mesh = with_cut_slave_faces(dressed(type), std::vector{face}, HexaCut::pyramids);
    std::vector<Nodes> found;
    for (int cell = 0; cell < count; ++cell) found.emplace_back(mesh.cell(cell).begin(), mesh.cell(cell).end());
    return found;
  };
  // Lines 1, 2 ... go from corner to corner; new nodes follow the corners.
  CHECK(pieces(tria3, 1, 2) == std::vector<Nodes>{{0, 3, 2}, {3, 1, 2}});
  CHECK(pieces(tria3, 2, 2) == std::vector<Nodes>{{1, 3, 0}, {3, 2, 0}});
  CHECK(pieces(quad4, 1, 4) == std::vector<Nodes>{{0, 4, 6, 3}, {4, 5, 7, 6}, {5, 1, 2, 7}, {2, 3, 6, 7}});
  const Mesh whole = dressed(tetra4);
  for (int face = 1; face <= 4; ++face) {
    const auto base = whole.cell(face);
    const int apex = 0 + 1 + 2 + 3 - base[0] - base[1] - base[2];
    CHECK(pieces(tetra4, face, 3) ==
          std::vector<Nodes>{{apex, base[0], base[1], 4}, {apex, base[1], base[2], 4}, {apex, base[2], base[0], 4}});
  }
}

TEST_CASE("Six hexahedra fill the one behind a slave face", "[mesh]") {
  const Mesh whole = dressed(CellType::hexa8);
  for (int face = 1; face < whole.cell_count(); ++face) {
    const Mesh mesh = with_cut_slave_faces(whole, std::vector{face}, HexaCut::hexahedra);
    CHECK(volume(mesh) == Approx(8.0).epsilon(1e-14));
    CHECK(is_closed(mesh));
    CHECK(std::ranges::count(mesh.cell_types, CellType::hexa8) == 6);
    REQUIRE(mesh.slave_patches.size() == 1);
    CHECK(mesh.slave_patches.front().size() == 5);
    CHECK(inner_nodes(mesh, mesh.slave_patches.front()).size() == 4);
    // Of each corner in turn the node inside the face, then each one's below it (Code_Aster 17.3).
    const auto at = [&](int node) { return Eigen::Vector3d(mesh.nodes[node].data()); };
    for (int added = 0; added < 8; ++added) {
      const int node = whole.node_count() + added;
      const int corner = whole.cell(face)[static_cast<std::size_t>(added % 4)];
      for (const int other : whole.cell(face))
        if (other != corner) CHECK((at(node) - at(corner)).norm() < (at(node) - at(other)).norm());
    }
  }
}

TEST_CASE("Four quadrangles fill the one behind a slave line, around one below its middle third") {
  Mesh whole = dressed(CellType::quad4);
  whole.nodes = {{0, 0, 0}, {3, 0, 0}, {5, 2, 0}, {-1, 2, 0}};
  const Mesh mesh = with_cut_slave_faces(whole, std::vector{1}, HexaCut::pyramids);
  for (int cell = 0; cell < 4; ++cell) CHECK(mesh.cell_types[static_cast<std::size_t>(cell)] == CellType::quad4);
  REQUIRE(mesh.nodes.size() == 8);
  // Half-way between the thirds of the line and those of the opposite side.
  const std::vector<Point> expected = {{1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2.5, 1, 0}};
  for (const Point& at : expected) {
    CAPTURE(at[0], at[1]);
    CHECK(std::ranges::any_of(mesh.nodes,
                              [&](const Point& node) { return std::hypot(node[0] - at[0], node[1] - at[1]) < 1e-14; }));
  }
  CHECK(volume(mesh) == Approx(signed_size(whole, 0)).epsilon(1e-14));
}

TEST_CASE("A body with several slave faces is cut for each", "[mesh]") {
  const Mesh whole = dressed(CellType::hexa8);
  for (const HexaCut cut : {HexaCut::pyramids, HexaCut::hexahedra}) {
    const Mesh mesh = with_cut_slave_faces(whole, std::vector{1, 2, 3}, cut);
    CHECK(volume(mesh) == Approx(8.0).epsilon(1e-14));
    CHECK(is_closed(mesh));
    CHECK(mesh.slave_patches.size() == 3);
  }
}

TEST_CASE("Faces with a node of their own inside stay whole, and become patches", "[mesh]") {
  using enum CellType;
  for (const CellType type : {tria6, quad8, hexa27}) {
    const Mesh whole = dressed(type);
    const Mesh mesh = with_cut_slave_faces(whole, std::vector{1}, HexaCut::pyramids);
    CHECK(mesh.cell_count() == whole.cell_count());
    REQUIRE(mesh.slave_patches == std::vector<std::vector<int>>{{1}});
    CHECK(inner_nodes(mesh, mesh.slave_patches.front()) == std::vector{mesh.cell(1).back()});
  }
}

TEST_CASE("Groups hold the pieces of their cells, the first under the old name", "[mesh]") {
  Mesh mesh = dressed(CellType::quad4);
  mesh.cell_names = {"BODY", "A", "B", "C", "D"};
  mesh.cell_groups = {{"EDGE", {1, 2}}, {"BODIES", {0}}};
  const Mesh cut = with_cut_slave_faces(mesh, mesh.cell_groups.at("EDGE"), HexaCut::pyramids);
  CHECK(cut.cell_groups.at("EDGE").size() == 6);
  // Four quadrangles, of which the second edge cuts one in four.
  CHECK(cut.cell_groups.at("BODIES").size() == 7);
  CHECK(cut.cell_names.size() == static_cast<std::size_t>(cut.cell_count()));
  CHECK(std::ranges::equal(cut.cell(cut.find_cell("A")), std::vector{0, 4}));
  CHECK(std::ranges::equal(cut.cell(cut.slave_patches.front().back()), std::vector{5, 1}));
}

TEST_CASE("Patches follow their cells into parts of the mesh", "[mesh]") {
  const Mesh mesh = with_cut_slave_faces(dressed(CellType::tetra4), std::vector{1, 2}, HexaCut::pyramids);
  REQUIRE(mesh.slave_patches.size() == 2);
  const Mesh part = restricted(mesh, mesh.slave_patches.back());
  REQUIRE(part.slave_patches.size() == 1);
  CHECK(part.slave_patches.front() == std::vector{0, 1, 2});
}

TEST_CASE("A slave face needs one body behind it", "[mesh]") {
  Mesh mesh = dressed(CellType::quad4);
  const std::vector<int> lone = {0, 2};
  const int diagonal = mesh.add_cell(CellType::seg2, lone);
  CHECK_THROWS_AS(with_cut_slave_faces(mesh, std::vector{diagonal}, HexaCut::pyramids), Error);
  mesh.nodes.push_back({3, -1, 0});
  const std::vector<int> beside = {1, 4, 2};
  mesh.add_cell(CellType::tria3, beside);
  CHECK_THROWS_AS(with_cut_slave_faces(mesh, std::vector{2}, HexaCut::pyramids), Error);
}
