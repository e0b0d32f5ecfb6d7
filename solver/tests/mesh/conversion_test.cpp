#include "solver/mesh/conversion.hpp"

#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "solver/error.hpp"
#include "solver/mesh/boundary.hpp"
#include "solver/mesh/reference_cell.hpp"
#include "solver/mesh/transform.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using Group = std::vector<int>;

namespace {

Mesh single(CellType type) {
  Mesh mesh;
  mesh.nodes = reference_points(type);
  std::vector<int> nodes(mesh.nodes.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  mesh.add_cell(type, nodes);
  return mesh;
}

const Group first_cell = {0};

/// Two QUAD4 side by side, with groups.
Mesh pair_of_faces() {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  mesh.add_cell(CellType::quad4, Group{0, 1, 4, 3});
  mesh.add_cell(CellType::quad4, Group{1, 2, 5, 4});
  mesh.cell_groups = {{"BOTH", {0, 1}}, {"RIGHT", {1}}};
  mesh.node_groups = {{"LEFT", {0, 3}}, {"ALL", {0, 1, 2, 3, 4, 5}}};
  return mesh;
}

}  // namespace

TEST_CASE("a converted reference cell is the reference cell of the new type", "[mesh]") {
  using enum CellType;
  const std::vector<std::tuple<CellType, Conversion, CellType>> cases = {
      {seg2, Conversion::to_quadratic, seg3},        {tria3, Conversion::to_quadratic, tria6},
      {quad4, Conversion::to_quadratic, quad8},      {tetra4, Conversion::to_quadratic, tetra10},
      {pyram5, Conversion::to_quadratic, pyram13},   {penta6, Conversion::to_quadratic, penta15},
      {hexa8, Conversion::to_quadratic, hexa20},     {hexa20, Conversion::hexa20_to_27, hexa27},
      {penta15, Conversion::penta15_to_18, penta18}, {quad8, Conversion::quad8_to_9, quad9},
      {quad8, Conversion::hexa20_to_27, quad9},      {hexa27, Conversion::to_linear, hexa8},
      {penta18, Conversion::to_linear, penta6},      {tria7, Conversion::to_linear, tria3},
      {tria6, Conversion::tria6_to_7, tria7}};
  for (const auto& [from, conversion, to] : cases) {
    CAPTURE(name_of(from), name_of(to));
    const Mesh mesh = converted(single(from), first_cell, conversion);
    REQUIRE(mesh.cell_types.front() == to);
    const auto expected = reference_points(to);
    REQUIRE(mesh.node_count() == static_cast<int>(expected.size()));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Point& node = mesh.nodes[static_cast<std::size_t>(mesh.cell(0)[i])];
      for (int axis = 0; axis < 3; ++axis) CHECK(node[axis] == Approx(expected[i][axis]).margin(1e-15));
    }
  }
}

TEST_CASE("cells of other types stay as they are", "[mesh]") {
  CHECK(with_triangles(single(CellType::tria3), first_cell).cell_types == std::vector{CellType::tria3});
  for (const auto& [type, conversion] :
       {std::pair(CellType::tria6, Conversion::to_quadratic), std::pair(CellType::quad4, Conversion::to_linear),
        std::pair(CellType::penta15, Conversion::hexa20_to_27)}) {
    const Mesh mesh = converted(single(type), first_cell, conversion);
    CHECK(mesh.cell_types == std::vector{type});
    CHECK(mesh.nodes == single(type).nodes);
  }
}

TEST_CASE("neighbours share the nodes of their edge, groups keep what they held", "[mesh]") {
  const Mesh mesh = converted(pair_of_faces(), Group{0, 1}, Conversion::to_quadratic);
  CHECK(mesh.node_count() == 6 + 7);
  CHECK(mesh.cell(0)[5] == mesh.cell(1)[7]);
  CHECK(mesh.cell_groups == pair_of_faces().cell_groups);
  CHECK(mesh.node_groups == pair_of_faces().node_groups);
  const Mesh back = converted(mesh, Group{0, 1}, Conversion::to_linear);
  CHECK(back.nodes == pair_of_faces().nodes);
  CHECK(back.connectivity == pair_of_faces().connectivity);
}

TEST_CASE("nodes between others are numbered along lines first, then along faces, then along solids", "[mesh]") {
  Mesh mesh = single(CellType::hexa8);
  mesh.add_cell(CellType::quad4, Group{4, 5, 6, 7});
  mesh.add_cell(CellType::seg2, Group{6, 7});
  const Mesh larger = converted(mesh, Group{0, 1, 2}, Conversion::to_quadratic);
  CHECK(larger.cell(2)[2] == 8);
  CHECK(Group(larger.cell(1).begin() + 4, larger.cell(1).end()) == Group{9, 10, 8, 11});
  CHECK(larger.cell(0)[8] == 12);
}

TEST_CASE("cells that stay as they are number the nodes that they share with converted ones", "[mesh]") {
  Mesh mesh = single(CellType::hexa8);
  mesh.add_cell(CellType::quad4, Group{4, 5, 6, 7});
  mesh.add_cell(CellType::seg2, Group{6, 7});
  const Mesh larger = converted(mesh, first_cell, Conversion::to_quadratic);
  CHECK(larger.node_count() == 20);
  CHECK(larger.cell_types[1] == CellType::quad4);
  // The line's node, those of the face, then the others of the solid.
  CHECK(Group(larger.cell(0).begin() + 16, larger.cell(0).end()) == Group{9, 10, 8, 11});
  CHECK(larger.cell(0)[8] == 12);
}

TEST_CASE("the middle of a curved face lies on the face", "[mesh]") {
  Mesh mesh = single(CellType::quad8);
  for (Point& node : mesh.nodes) node[2] = node[0] * node[0];  // a parabolic cylinder, which QUAD8 represents exactly
  mesh.nodes[4][0] = mesh.nodes[6][0] = 0.25;
  const Mesh larger = converted(mesh, first_cell, Conversion::quad8_to_9);
  CHECK(larger.nodes.back()[0] == exactly(0.25));
  CHECK(larger.nodes.back()[1] == Approx(0.0).margin(1e-15));
}

TEST_CASE("doubled cells and points are cells of their own in a new group", "[mesh]") {
  Mesh mesh = pair_of_faces();
  double_cells(mesh, mesh.cell_groups.at("RIGHT"), "TWIN");
  add_points(mesh, Group{5, 0}, "ENDS");
  CHECK(mesh.cell_group("TWIN") == Group{2});
  CHECK(Group(mesh.cell(2).begin(), mesh.cell(2).end()) == Group{1, 2, 5, 4});
  CHECK(mesh.cell_group("ENDS") == Group{3, 4});
  CHECK(mesh.cell_types[3] == CellType::poi1);
  CHECK(mesh.cell(3)[0] == 0);
  CHECK(mesh.cell(4)[0] == 5);
  CHECK_THROWS_AS(add_points(mesh, Group{1}, "TWIN"), Error);
}

TEST_CASE("a part of a mesh keeps names and what remains of its groups", "[mesh]") {
  const Mesh part = restricted(pair_of_faces(), Group{1});
  CHECK(part.node_count() == 4);
  CHECK(part.cell_count() == 1);
  CHECK(part.cell_name(0) == "M2");
  CHECK(part.node_name(0) == "N2");
  CHECK(part.find_node("N1") == -1);
  CHECK(part.cell_groups.at("BOTH") == Group{0});
  CHECK_FALSE(part.node_groups.contains("LEFT"));
  // Numbered as the cell meets them.
  CHECK(Group(part.cell(0).begin(), part.cell(0).end()) == Group{0, 1, 2, 3});
  CHECK(part.node_groups.at("ALL") == Group{0, 1, 3, 2});
  CHECK(std::abs(signed_size(part, 0)) == exactly(1.0));
}

TEST_CASE("moving a mesh keeps its sizes as the motion says", "[mesh]") {
  const auto moved = [](auto&& move) {
    Mesh mesh = single(CellType::hexa8);
    move(mesh);
    return signed_size(mesh, 0);
  };
  CHECK(moved([](Mesh& m) { scale(m, 0.5); }) == exactly(1.0));
  CHECK(moved([](Mesh& m) { translate(m, {1, 2, 3}); }) == exactly(8.0));
  CHECK(moved([](Mesh& m) { rotate(m, {1, 2, 3}, {1, 1, 0}, 0.7); }) == exactly(8.0));
  CHECK(moved([](Mesh& m) { mirror(m, {1, 2, 3}, {1, 1, 0}); }) == exactly(-8.0));
  CHECK(moved([](Mesh& m) { change_axes(m, {1, 2, 3}, {1, 1, 0}); }) == exactly(8.0));
  Mesh mesh;
  mesh.nodes = {{2, 0, 0}};
  rotate(mesh, {1, 0, 0}, {0, 0, 2}, std::acos(0.0));
  CHECK(mesh.nodes[0][0] == exactly(1.0));
  CHECK(mesh.nodes[0][1] == exactly(1.0));
  change_axes(mesh, {0, 3, 0}, {-1, 0, 0});
  CHECK(mesh.nodes[0][0] == exactly(1.0));
  CHECK(mesh.nodes[0][1] == exactly(-1.0));
  mirror(mesh, {0, 5, 0}, {0, -1, 0});
  CHECK(mesh.nodes[0][1] == exactly(11.0));
  CHECK_THROWS_AS(rotate(mesh, {0, 0, 0}, {0, 0, 0}, 1.0), Error);
  CHECK_THROWS_AS(change_axes(mesh, {1, 0, 0}, {2, 0, 0}), Error);
}

TEST_CASE("a plane mesh that is moved out of its plane is one in space", "[mesh]") {
  const auto dimension_after = [](auto&& move) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    move(mesh);
    return mesh.dimension;
  };
  CHECK(dimension_after([](Mesh& m) { rotate(m, {0, 0, 0}, {0, 0, 1}, 0.7); }) == 2);
  CHECK(dimension_after([](Mesh& m) { mirror(m, {1, 2, 0}, {1, 1, 0}); }) == 2);
  CHECK(dimension_after([](Mesh& m) { rotate(m, {0, 0, 0}, {1, 0, 0}, 0.7); }) == 3);
  CHECK(dimension_after([](Mesh& m) { translate(m, {0, 0, 1}); }) == 3);
}

TEST_CASE("a field of displacements moves the nodes that carry it", "[mesh]") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}};
  displace(mesh, {.quantity = "DEPL_R", .components = {"DX", "DY"}, .values = {0.5, -1.0, absent, absent}});
  CHECK(mesh.nodes == std::vector<Point>{{0.5, -1, 0}, {1, 0, 0}});
  CHECK_THROWS_AS(displace(mesh, {.quantity = "TEMP_R", .components = {"TEMP"}, .values = {1, 2}}), Error);
  CHECK_THROWS_AS(displace(mesh, {.quantity = "DEPL_R", .components = {"DX"}, .values = {1}}), Error);
}

TEST_CASE("quadrangles cut into triangles keep area, sense and groups", "[mesh]") {
  const Mesh mesh = with_triangles(pair_of_faces(), Group{0, 1});
  REQUIRE(mesh.cell_count() == 4);
  double area = 0.0;
  for (int cell = 0; cell < 4; ++cell) {
    CHECK(mesh.cell_types[static_cast<std::size_t>(cell)] == CellType::tria3);
    const auto nodes = mesh.cell(cell);
    const Point &a = mesh.nodes[nodes[0]], &b = mesh.nodes[nodes[1]], &c = mesh.nodes[nodes[2]];
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    CHECK(twice > 0.0);
    area += 0.5 * twice;
  }
  CHECK(area == exactly(2.0));
  CHECK(mesh.cell_group("BOTH").size() == 4);
  CHECK(mesh.cell_group("RIGHT").size() == 2);
  // Pieces stand where the whole stood.
  CHECK(mesh.cell_group("RIGHT") == Group{2, 3});
  CHECK(with_triangles(pair_of_faces(), first_cell).cell_group("RIGHT") == Group{2});
  // Only the first is cut.
  CHECK(with_triangles(pair_of_faces(), first_cell).cell_group("BOTH").size() == 3);
  for (const auto& [type, pieces] : {std::pair(CellType::quad8, 6), std::pair(CellType::quad9, 8)}) {
    const Mesh whole = single(type);
    const Mesh cut = with_triangles(whole, first_cell);
    REQUIRE(cut.cell_count() == pieces);
    double size = 0.0;
    for (int cell = 0; cell < pieces; ++cell) {
      CHECK(signed_size(cut, cell) * signed_size(whole, 0) > 0.0);
      size += signed_size(cut, cell);
    }
    CHECK(size == exactly(signed_size(whole, 0)));
  }
}
