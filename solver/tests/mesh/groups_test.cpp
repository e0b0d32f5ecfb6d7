#include "solver/mesh/groups.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "reference_cells.hpp"
#include "solver/error.hpp"
#include "solver/mesh/boundary.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using Group = std::vector<int>;

namespace {

/// Twelve nodes on the unit circle, and the arcs between them as SEG2, written in a jumbled order and sense.
Mesh circle() {
  Mesh mesh;
  for (int i = 0; i < 12; ++i) {
    const double angle = i * std::numbers::pi / 6.0;
    mesh.nodes.push_back({std::cos(angle), std::sin(angle), 0.0});
  }
  for (int i = 0; i < 12; ++i) {
    const int from = (5 * i) % 12;
    const int to = (from + 1) % 12;
    mesh.add_cell(CellType::seg2, i % 3 == 0 ? Group{to, from} : Group{from, to});
  }
  return mesh;
}

/// Three quadratic segments along x from 0 to 3, the second one against the others.
Mesh quadratic_line() {
  Mesh mesh;
  for (int i = 0; i <= 6; ++i) mesh.nodes.push_back({0.5 * i, 0.0, 0.0});
  mesh.add_cell(CellType::seg3, Group{4, 2, 3});
  mesh.add_cell(CellType::seg3, Group{0, 2, 1});
  mesh.add_cell(CellType::seg3, Group{4, 6, 5});
  return mesh;
}

Mesh cube_of_hexa27() {
  Mesh mesh;
  Group nodes;
  for (const auto& point : tests::reference_nodes(CellType::hexa27)) {
    nodes.push_back(mesh.node_count());
    mesh.nodes.push_back({point.x(), point.y(), point.z()});
  }
  mesh.add_cell(CellType::hexa27, nodes);
  return mesh;
}

}  // namespace

TEST_CASE("set operations keep the order of the first group") {
  const std::vector<Group> groups = {{5, 1, 3, 2}, {2, 9, 5}, {7, 5, 2}};
  CHECK(union_of(groups) == Group{5, 1, 3, 2, 9, 7});
  CHECK(intersection_of(groups) == Group{5, 2});
  CHECK(difference_of(groups) == Group{1, 3});
  CHECK(union_of({}).empty());
  CHECK(intersection_of({}).empty());
  CHECK(difference_of({}).empty());
}

TEST_CASE("every cell group gets its node group, and none is replaced") {
  Mesh mesh = circle();
  mesh.cell_groups["ARC"] = {0};
  mesh.cell_groups["ALL"] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  mesh.cell_groups["OTHER"] = {1};
  mesh.node_groups["OTHER"] = {0};
  CHECK(add_node_groups_of_all_cell_groups(mesh) == std::vector<std::string>{"OTHER"});
  CHECK(mesh.node_groups.at("ARC") == Group{0, 1});
  CHECK(mesh.node_groups.at("ALL").size() == 12);
  CHECK(mesh.node_groups.at("OTHER") == Group{0});
  CHECK(add_node_groups_of_all_cell_groups(mesh) == std::vector<std::string>{"OTHER"});
}

TEST_CASE("nodes play corner, middle and centre as their coordinates say") {
  for (int i = 0; i < cell_type_count; ++i) {
    const auto type = static_cast<CellType>(i);
    INFO(name_of(type));
    Mesh mesh;
    mesh.nodes.resize(static_cast<std::size_t>(node_count(type)));
    Group nodes;
    for (int j = 0; j < node_count(type); ++j) nodes.push_back(j);
    mesh.add_cell(type, nodes);
    const auto corners = nodes_of_cells(mesh, Group{0}, NodeRole::corner);
    const auto middles = nodes_of_cells(mesh, Group{0}, NodeRole::mid_edge);
    const auto centres = nodes_of_cells(mesh, Group{0}, NodeRole::centre);
    CHECK(static_cast<int>(corners.size()) == corner_count(type));
    CHECK(corners.size() + middles.size() + centres.size() == nodes.size());
  }
  const Mesh cube = cube_of_hexa27();
  for (const int node : nodes_of_cells(cube, Group{0}, NodeRole::mid_edge)) {
    const auto& [x, y, z] = cube.nodes[node];
    CHECK(std::abs(x) + std::abs(y) + std::abs(z) == exactly(2.0));
  }
  CHECK(nodes_of_cells(cube, Group{0}, NodeRole::centre).size() == 7);
}

TEST_CASE("nodes are found by where they lie") {
  const Mesh cube = cube_of_hexa27();
  CHECK(nodes_on_plane(cube, {5, 5, 1}, {0, 0, -3}, 1e-9).size() == 9);
  CHECK(nodes_in_ball(cube, {0, 0, 0}, 1.1).size() == 7);
  CHECK(nodes_on_sphere(cube, {0, 0, 0}, std::sqrt(2.0), 1e-9).size() == 12);
  CHECK(nodes_in_cylinder(cube, {0, 0, 7}, {0, 0, 2}, 1.1).size() == 15);
  CHECK(nodes_on_cylinder(cube, {0, 0, 7}, {0, 0, 2}, 1.0, 1e-9).size() == 12);
  CHECK_THROWS_AS(nodes_on_plane(cube, {0, 0, 0}, {0, 0, 0}, 1.0), Error);
}

TEST_CASE("cells are found by their nodes") {
  const Mesh mesh = quadratic_line();
  const Group nodes = {0, 1, 2, 3};
  CHECK(cells_on_nodes(mesh, nodes, NodeCriterion::all) == Group{1});
  CHECK(cells_on_nodes(mesh, nodes, NodeCriterion::any) == Group{0, 1});
  CHECK(cells_on_nodes(mesh, nodes, NodeCriterion::majority) == Group{0, 1});
  // Half of the nodes are enough.
  CHECK(cells_on_nodes(cube_of_hexa27(), Group{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, NodeCriterion::majority)
            .empty());
  Mesh square;
  square.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.add_cell(CellType::quad4, Group{0, 1, 2, 3});
  CHECK(cells_on_nodes(square, Group{1, 3}, NodeCriterion::majority) == Group{0});
}

TEST_CASE("an open line is walked from end to end") {
  const Mesh mesh = quadratic_line();
  const Group all = {0, 1, 2};
  const Group there = {0, 1, 2, 3, 4, 5, 6};
  const Group back(there.rbegin(), there.rend());
  CHECK(nodes_along_line(mesh, all) == there);
  CHECK(nodes_along_line(mesh, all, 6) == back);
  CHECK(nodes_along_line(mesh, all, {}, 0) == back);
  CHECK(nodes_along_line(mesh, all, 0, 6) == there);
  CHECK_THROWS_AS(nodes_along_line(mesh, all, 2), Error);
  CHECK_THROWS_AS(nodes_along_line(mesh, all, 0, 0), Error);
  CHECK_THROWS_AS(nodes_along_line(mesh, Group{1, 2}), Error);
  CHECK_THROWS_AS(nodes_along_line(mesh, Group{}), Error);
}

TEST_CASE("a line begins at the end that a cell begins with, else at the first end in the mesh") {
  const auto walk = [](std::initializer_list<std::array<int, 2>> cells, const Group& order) {
    Mesh mesh;
    mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    for (const auto& cell : cells) mesh.add_cell(CellType::seg2, cell);
    return nodes_along_line(mesh, order);
  };
  const Group there = {0, 1, 2, 3}, back = {3, 2, 1, 0};
  const Group as_numbered = {0, 1, 2};
  CHECK(walk({{1, 0}, {2, 1}, {3, 2}}, as_numbered) == back);
  CHECK(walk({{2, 3}, {1, 2}, {0, 1}}, as_numbered) == there);
  CHECK(walk({{1, 0}, {1, 2}, {3, 2}}, as_numbered) == back);
  CHECK(walk({{1, 0}, {1, 2}, {2, 3}}, as_numbered) == there);
  CHECK(walk({{0, 1}, {1, 2}, {3, 2}}, Group{2, 1, 0}) == there);
}

TEST_CASE("a closed line is walked once round") {
  const Mesh mesh = circle();
  Group all;
  for (int i = 0; i < 12; ++i) all.push_back(i);
  const Group round = nodes_along_line(mesh, all, 3, 3, Point{-1, 0, 0});
  const Group other_way = nodes_along_line(mesh, all, 3, {}, Point{1, 0, 0});
  REQUIRE(round.size() == 12);
  for (int i = 0; i < 12; ++i) {
    CHECK(round[i] == (3 + i) % 12);
    CHECK(other_way[i] == (15 - i) % 12);
  }
  CHECK(nodes_along_line(mesh, all).size() == 12);
  CHECK_THROWS_AS(nodes_along_line(mesh, all, 0, 1), Error);
}

TEST_CASE("a fork is not a line") {
  Mesh mesh = quadratic_line();
  mesh.nodes.push_back({1, 1, 0});
  mesh.add_cell(CellType::seg2, Group{2, 7});
  CHECK_THROWS_AS(nodes_along_line(mesh, Group{0, 1, 2, 3}), Error);
  mesh.add_cell(CellType::poi1, Group{2});
  CHECK_THROWS_AS(nodes_along_line(mesh, Group{4}), Error);
}

TEST_CASE("nodes that follow each other along a line are told from nodes that do not") {
  const Mesh mesh = quadratic_line();
  const Group along = nodes_along_line(mesh, Group{0, 1, 2});
  CHECK_FALSE(node_out_of_order(mesh, along));
  CHECK_FALSE(node_out_of_order(mesh, Group{along[0], along[2], along[4]}));
  CHECK(node_out_of_order(mesh, Group{along[0], along[4], along[2], along[6]}) == along[4]);
  // The middle of an edge lies between its corners, however sharply it is bent.
  Mesh edge;
  edge.nodes = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}};
  edge.add_cell(CellType::seg3, Group{0, 1, 2});
  CHECK_FALSE(node_out_of_order(edge, Group{0, 2, 1}));
  CHECK(node_out_of_order(edge, Group{0, 1, 2}) == 1);
  Mesh crack;
  crack.nodes = {{1, 0.1, 0}, {0, 0, 0}, {1, -0.1, 0}};
  crack.add_cell(CellType::seg2, Group{0, 1});
  crack.add_cell(CellType::seg2, Group{1, 2});
  CHECK_FALSE(node_out_of_order(crack, Group{0, 1, 2}));
  Mesh face;
  face.nodes = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  face.add_cell(CellType::quad4, Group{0, 1, 2, 3});
  CHECK_FALSE(node_out_of_order(face, Group{0, 1, 2, 3}));
  CHECK(node_out_of_order(face, Group{0, 1, 3, 2}) == 1);
}

TEST_CASE("nodes on a straight line are sorted along it") {
  const Mesh mesh = quadratic_line();
  CHECK(nodes_along_segment(mesh, Group{3, 6, 0, 5}, 6, 0, 1e-9) == Group{6, 5, 3, 0});
  const Mesh curved = circle();
  CHECK_THROWS_AS(nodes_along_segment(curved, Group{0, 1, 2}, 0, 2, 1e-3), Error);
  CHECK_THROWS_AS(nodes_along_segment(curved, Group{0, 1, 2}, 0, 0, 1e-3), Error);
}

TEST_CASE("faces are chosen by their normal, of one sense or either") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
  const int up = mesh.add_cell(CellType::quad4, Group{0, 1, 2, 3});
  const int down = mesh.add_cell(CellType::tria3, Group{0, 2, 1});
  mesh.add_cell(CellType::tria3, Group{0, 4, 1});
  mesh.add_cell(CellType::seg2, Group{0, 1});
  const double degree = std::numbers::pi / 180.0;
  CHECK(cells_with_normal(mesh, {0, 0.1, 1}, 6 * degree, false) == Group{up});
  CHECK(cells_with_normal(mesh, {0, 0.1, 1}, 6 * degree, true) == Group{up, down});
  CHECK(cells_with_normal(mesh, {0, 0.1, 1}, 5 * degree, true).empty());
  CHECK_THROWS_AS(cells_with_normal(mesh, {0, 0, 0}, 1.0, true), Error);
}

TEST_CASE("in the plane lines are chosen by their normal, and faces by the one out of it") {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const int face = mesh.add_cell(CellType::quad4, Group{0, 1, 2, 3});
  const int side = mesh.add_cell(CellType::seg2, Group{0, 1});
  const double degree = std::numbers::pi / 180.0;
  CHECK(cells_with_normal(mesh, {0, -1, 0}, degree, false) == Group{side});
  CHECK(cells_with_normal(mesh, {0, 0, 1}, degree, false) == Group{face});
  CHECK(cells_with_normal(mesh, {0, 0, -1}, degree, false).empty());
}

TEST_CASE("a quadratic cell can be chosen by its corners alone") {
  const Mesh line = quadratic_line();
  CHECK(cells_on_nodes(line, Group{2, 4}, NodeCriterion::corners) == Group{0});
  CHECK(cells_on_nodes(line, Group{2, 4}, NodeCriterion::all).empty());
}
