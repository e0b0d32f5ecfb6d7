#include "solver/mesh/orientation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include "reference_cells.hpp"
#include "solver/error.hpp"
#include "solver/mesh/boundary.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using comma::solver::tests::Vector;

namespace orientation_test {

/// A block of nx * ny * nz unit cubes.
Mesh block(int nx, int ny, int nz) {
  Mesh mesh;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) mesh.nodes.push_back({1.0 * i, 1.0 * j, 1.0 * k});
    }
  }
  const auto node = [&](int i, int j, int k) { return i + (nx + 1) * (j + (ny + 1) * k); };
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        mesh.add_cell(CellType::hexa8, std::vector{node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                                                   node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                                                   node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
      }
    }
  }
  return mesh;
}

std::vector<int> all_cells(const Mesh& mesh) {
  std::vector<int> cells;
  for (int i = 0; i < mesh.cell_count(); ++i) cells.push_back(i);
  return cells;
}

/// Adds a skin cell on each boundary facet, with its nodes turned either way at random; returns the cells.
std::vector<int> add_random_skin(Mesh& mesh, std::mt19937& random) {
  std::vector<int> skin;
  for (const CellFacet facet : boundary_of(mesh, all_cells(mesh))) {
    const CellType type = boundary_facets(mesh.cell_types[facet.cell])[static_cast<std::size_t>(facet.facet)].type;
    std::vector<int> nodes = nodes_of_facet(mesh, facet);
    const int corners = corner_count(type);
    if (random() % 2 == 0) {
      std::reverse(nodes.begin(), nodes.begin() + corners);
      if (dimension(type) == 2 && node_count(type) >= 2 * corners) {
        std::reverse(nodes.begin() + corners, nodes.begin() + 2 * corners - 1);
      }
    }
    skin.push_back(mesh.add_cell(type, nodes));
  }
  return skin;
}

/// The volume that a skin of faces encloses, by the divergence theorem over the corners, and the sum of its area
/// vectors.
std::pair<double, Vector> enclosed(const Mesh& mesh, const std::vector<int>& skin) {
  double volume = 0.0;
  Vector closed = Vector::Zero();
  for (const int cell : skin) {
    std::vector<Vector> points;
    for (const int node : mesh.cell(cell)) points.push_back(Vector(mesh.nodes[node].data()));
    const BoundaryFacet itself{mesh.cell_types[cell], {0, 1, 2, 3, 4, 5, 6, 7, 8}};
    const Vector area = tests::area_vector(points, itself);
    closed += area;
    volume += area.dot(tests::corner_mean(points, itself)) / 3.0;
  }
  return {volume, closed};
}

std::string code_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.code();
  }
  return "no error";
}

TEST_CASE("the turned skin of a block encloses its volume") {
  std::mt19937 random(1);
  Mesh mesh = block(3, 2, 2);
  const auto skin = add_random_skin(mesh, random);
  REQUIRE(skin.size() == 2 * (3 * 2 + 3 * 2 + 2 * 2));
  const int turned = orient_skin(mesh, skin);
  CHECK(turned > 0);
  const auto [volume, closed] = enclosed(mesh, skin);
  CHECK(volume == Approx(12.0).epsilon(1e-14));
  CHECK(closed.norm() == Approx(0.0).margin(1e-13));
  CHECK(orient_skin(mesh, skin) == 0);
}

TEST_CASE("every solid gets its skin turned outwards, middle nodes kept between their corners") {
  std::mt19937 random(2);
  for (int i = 0; i < cell_type_count; ++i) {
    const auto type = static_cast<CellType>(i);
    if (dimension(type) != 3) continue;
    INFO(name_of(type));
    Mesh mesh;
    std::vector<int> nodes;
    for (const Vector& point : tests::reference_nodes(type)) {
      nodes.push_back(mesh.node_count());
      mesh.nodes.push_back({point.x(), point.y(), point.z()});
    }
    mesh.add_cell(type, nodes);
    const auto skin = add_random_skin(mesh, random);
    orient_skin(mesh, skin);
    CHECK(enclosed(mesh, skin).first == Approx(tests::reference_volume(type)).epsilon(1e-14));
    for (const int cell : skin) {
      const auto face = mesh.cell(cell);
      const int corners = corner_count(mesh.cell_types[cell]);
      if (node_count(mesh.cell_types[cell]) < 2 * corners) continue;
      for (int j = 0; j < corners; ++j) {
        const Vector a(mesh.nodes[face[j]].data());
        const Vector b(mesh.nodes[face[(j + 1) % corners]].data());
        const Vector middle(mesh.nodes[face[corners + j]].data());
        CHECK((middle - 0.5 * (a + b)).norm() == Approx(0.0).margin(1e-15));
      }
    }
  }
}

TEST_CASE("edges of plane cells run with the cell on their left, whichever way the cell itself runs") {
  for (const bool clockwise : {false, true}) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.add_cell(CellType::quad4, clockwise ? std::vector{0, 3, 2, 1} : std::vector{0, 1, 2, 3});
    const int down = mesh.add_cell(CellType::seg2, std::vector{1, 0});
    const int up = mesh.add_cell(CellType::seg2, std::vector{2, 3});
    CHECK(orient_skin(mesh, std::vector{down, up}) == 1);
    CHECK(mesh.cell(down)[0] == 0);
    CHECK(mesh.cell(up)[0] == 2);
  }
}

TEST_CASE("a solid whose nodes run inside out gets its skin outside all the same") {
  std::mt19937 random(3);
  Mesh mesh = block(1, 1, 1);
  std::reverse(mesh.connectivity.begin(), mesh.connectivity.begin() + 4);
  std::reverse(mesh.connectivity.begin() + 4, mesh.connectivity.end());
  REQUIRE(signed_size(mesh, 0) == exactly(-1.0));
  const auto skin = add_random_skin(mesh, random);
  orient_skin(mesh, skin);
  CHECK(enclosed(mesh, skin).first == exactly(1.0));
}

TEST_CASE(
    "a triangle that is turned exchanges its first corner and its third; the second corner stays where contact knows "
    "it") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0},     {1, 0, 0},   {0, 1, 0},   {0, 0, 1},     {0.5, 0, 0},
                {0.5, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  mesh.add_cell(CellType::tetra10, std::vector{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  const int linear = mesh.add_cell(CellType::tria3, std::vector{1, 2, 0});
  const int quadratic = mesh.add_cell(CellType::tria6, std::vector{1, 2, 0, 5, 6, 4});
  CHECK(orient_skin(mesh, std::vector{linear, quadratic}) == 2);
  CHECK(std::ranges::equal(mesh.cell(linear), std::vector{0, 2, 1}));
  CHECK(std::ranges::equal(mesh.cell(quadratic), std::vector{0, 2, 1, 6, 5, 4}));
}

TEST_CASE("a quadrangle that is turned takes its corners in the opposite order, the last one first") {
  Mesh mesh;
  for (const auto& at : tests::reference_nodes(CellType::hexa20)) mesh.nodes.push_back({at[0], at[1], at[2]});
  std::vector<int> body(20);
  std::iota(body.begin(), body.end(), 0);
  mesh.add_cell(CellType::hexa20, body);
  const BoundaryFacet& facet = boundary_facets(CellType::hexa20)[0];
  const auto node = [&](int place) { return facet.nodes[static_cast<std::size_t>(place)]; };
  const std::vector<int> outward = {node(0), node(1), node(2), node(3), node(4), node(5), node(6), node(7)};
  const std::vector<int> inward = {node(3), node(2), node(1), node(0), node(6), node(5), node(4), node(7)};
  const int face = mesh.add_cell(CellType::quad8, inward);
  CHECK(orient_skin(mesh, std::vector{face}) == 1);
  CHECK(std::ranges::equal(mesh.cell(face), outward));
}

TEST_CASE("a skin without one clear side is an error") {
  Mesh mesh = block(2, 1, 1);
  const int inside = mesh.add_cell(CellType::quad4, std::vector{1, 4, 10, 7});
  const int loose = mesh.add_cell(CellType::quad4, std::vector{0, 1, 10, 9});
  CHECK(code_of([&] { orient_skin(mesh, std::vector{inside}); }) == "skin-inside-body");
  CHECK(code_of([&] { orient_skin(mesh, std::vector{loose}); }) == "skin-without-support");
  CHECK(loose_skin(mesh, std::vector{inside, loose}) == std::vector{loose});
  CHECK(orient_skin(mesh, std::vector{inside}, std::vector{0}) +
            orient_skin(mesh, std::vector{inside}, std::vector{1}) >=
        1);
  mesh.nodes[0] = mesh.nodes[3] = {1, 0, 0};
  for (auto& point : mesh.nodes) point[0] = 0.0;
  CHECK(code_of([&] { orient_skin(mesh, std::vector{inside}, std::vector{0}); }) == "flat-cell");
}

TEST_CASE("the faces of a warped sheet get normals on the side that is asked for") {
  // A strip of quadrangles bent round a half circle, each written in a sense and from a corner of its own.
  Mesh mesh;
  const int count = 9;
  for (int i = 0; i <= count; ++i) {
    const double angle = std::acos(-1.0) * i / count;
    for (const double z : {0.0, 1.0}) mesh.nodes.push_back({std::cos(angle), std::sin(angle), z});
  }
  std::vector<int> cells;
  for (int i = 0; i < count; ++i) {
    std::vector<int> nodes = {2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1};
    std::rotate(nodes.begin(), nodes.begin() + i % 4, nodes.end());
    if (i % 3 == 1) std::reverse(nodes.begin(), nodes.end());
    cells.push_back(mesh.add_cell(CellType::quad4, nodes));
  }
  const auto outwards = [&](int cell) {
    const Eigen::Vector3d a(mesh.nodes[mesh.cell(cell)[0]].data());
    const Eigen::Vector3d b(mesh.nodes[mesh.cell(cell)[1]].data());
    const Eigen::Vector3d c(mesh.nodes[mesh.cell(cell)[2]].data());
    const Eigen::Vector3d middle = (a + c) / 2.0;
    return (b - a).cross(c - a).dot(Eigen::Vector3d(middle[0], middle[1], 0.0)) > 0.0;
  };
  CHECK(unlike_neighbours(mesh, cells) == std::pair(cells[0], cells[1]));
  CHECK(orient_normals(mesh, cells, OrientationSeed{0, {1.0, 0.1, 0.0}}) == 3);
  CHECK_FALSE(unlike_neighbours(mesh, cells));
  CHECK(std::ranges::all_of(cells, outwards));
  CHECK(orient_normals(mesh, cells, OrientationSeed{2 * count, {1.0, 0.0, 0.0}}) == count);
  CHECK(std::ranges::none_of(cells, outwards));
  CHECK(orient_normals(mesh, cells, std::nullopt) == 0);
  CHECK(code_of([&] { orient_normals(mesh, cells, OrientationSeed{0, {0.0, 0.0, 1.0}}); }) == "ambiguous-direction");
  // Twins on the same nodes run alike; a cell elsewhere is another piece.
  const std::vector<int> nodes = {0, 2, 3, 1};
  cells.push_back(mesh.add_cell(CellType::quad4, nodes));
  orient_normals(mesh, cells, OrientationSeed{0, {1.0, 0.1, 0.0}});
  CHECK(std::ranges::all_of(cells, outwards));
  mesh.nodes.insert(mesh.nodes.end(), {Point{5, 0, 0}, Point{6, 0, 0}, Point{5, 1, 0}});
  const int first = mesh.node_count() - 3;
  cells.push_back(mesh.add_cell(CellType::tria3, std::vector{first, first + 1, first + 2}));
  CHECK(code_of([&] { orient_normals(mesh, cells, std::nullopt); }) == "several-pieces");
}

TEST_CASE("a face of a sheet that is turned keeps its first node, and middle nodes between their corners") {
  for (const CellType type : {CellType::quad8, CellType::tria6}) {
    Mesh mesh;
    mesh.nodes = reference_points(type);
    std::vector<int> nodes(mesh.nodes.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    mesh.add_cell(type, nodes);
    orient_normals(mesh, std::vector{0}, OrientationSeed{0, {0.0, 0.0, -1.0}});
    const auto turned = mesh.cell(0);
    CHECK(turned[0] == 0);
    CHECK(signed_size(mesh, 0) < 0.0);
    const auto edges = middle_edges(type);
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t axis = 0; axis < 2; ++axis)
        CHECK(mesh.nodes[turned[corner_count(type) + i]][axis] ==
              (mesh.nodes[turned[edges[i][0]]][axis] + mesh.nodes[turned[edges[i][1]]][axis]) / 2);
  }
}

TEST_CASE("a sheet with one side only cannot be turned") {
  Mesh mesh;  // Moebius: a strip of triangles closed with a half twist
  const int count = 5;
  for (int i = 0; i < count; ++i) mesh.nodes.push_back({std::cos(1.2566 * i), std::sin(1.2566 * i), 0.1 * i});
  std::vector<int> cells;
  for (int i = 0; i < count; ++i) {
    cells.push_back(mesh.add_cell(CellType::tria3, std::vector{i, (i + 1) % count, (i + 2) % count}));
  }
  CHECK(code_of([&] { orient_normals(mesh, cells, std::nullopt); }) == "not-orientable");
}

TEST_CASE("the segments of a line follow each other from the end that is asked for") {
  Mesh mesh;
  for (int i = 0; i < 5; ++i) mesh.nodes.push_back({1.0 * i, 0.3 * i * i, 0.0});
  std::vector<int> cells;
  for (int i = 0; i < 4; ++i)
    cells.push_back(mesh.add_cell(CellType::seg2, i % 2 == 0 ? std::vector{i, i + 1} : std::vector{i + 1, i}));
  CHECK(unlike_neighbours(mesh, cells));
  CHECK(orient_lines(mesh, cells, OrientationSeed{4, {-1.0, 0.0, 0.0}}) == 2);
  CHECK_FALSE(unlike_neighbours(mesh, cells));
  for (int i = 0; i < 4; ++i) CHECK(mesh.cell(cells[i])[0] == i + 1);
  const int face = mesh.add_cell(CellType::tria3, std::vector{0, 1, 2});
  CHECK(code_of([&] { orient_lines(mesh, std::vector{face}, std::nullopt); }) == "wrong-cell");
}

}  // namespace orientation_test
