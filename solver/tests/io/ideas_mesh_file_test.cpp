#include "solver/io/ideas_mesh_file.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/mesh/reference_cell.hpp"

using namespace comma::solver;
using Group = std::vector<int>;

namespace ideas_mesh_file_test {

// A square of two triangles with its lower edge. Numbers begin at 5 and skip 7.
const std::string square = R"(    -1
   151
anything at all
    -1
    -1
  2411
         5         1         1        11
   0.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00
         6         1         1        11
   1.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00
         8         1         1        11
   1.0000000000000000D+00   1.0000000000000000D+00   0.0000000000000000D+00
         9         1         1        11
   0.0000000000000000D+00   1.0000000000000000D+00   0.0000000000000000D+00
    -1
    -1
  2412
         1        21         2         1         7         2
         0         1         1
         5         6
         2        91         1         1         7         3
         5         6         8
         4        91         1         1         7         3
         5         8         9
    -1
    -1
  2467
         1         0         0         0         0         0         0         3
PLATE
         8         2         0         0         8         4         0         0
         7         9         0         0
         2         0         0         0         0         0         0         1
EDGE lower
         8         1         0         0
    -1
)";

// A cell whose nodes stand where `places` says, in the order of the file.
std::string single(int descriptor, const std::vector<Point>& places) {
  std::string text = "    -1\n    15\n", nodes;
  for (std::size_t i = 0; i < places.size(); ++i) {
    text += fmt::format("{:10}{:10}{:10}{:10}{:13.5E}{:13.5E}{:13.5E}\n", i + 1, 0, 0, 11, places[i][0], places[i][1],
                        places[i][2]);
    nodes += fmt::format("{:10}{}", i + 1, (i + 1) % 8 == 0 || i + 1 == places.size() ? "\n" : "");
  }
  const char* orientation = descriptor == 24 ? "         0         1         1\n" : "";
  return text + fmt::format("    -1\n    -1\n  2412\n{:10}{:10}{:10}{:10}{:10}{:10}\n{}{}    -1\n", 1, descriptor, 1, 1,
                            7, places.size(), orientation, nodes);
}

Point between(const Point& a, const Point& b) { return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}; }

// Corners and the middles between them, going round.
void add_ring(std::vector<Point>& places, const std::vector<Point>& corners, bool closed = true) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    places.push_back(corners[i]);
    if (closed || i + 1 < corners.size()) places.push_back(between(corners[i], corners[(i + 1) % corners.size()]));
  }
}

TEST_CASE("a universal file gives nodes, cells and groups", "[io]") {
  const Mesh mesh = parse_ideas_mesh(square, "square.unv");
  CHECK(mesh.dimension == 2);
  CHECK(mesh.node_count() == 4);
  REQUIRE(mesh.cell_count() == 3);
  CHECK(mesh.cell_types[0] == CellType::seg2);
  CHECK(mesh.cell_types[2] == CellType::tria3);
  CHECK(mesh.nodes[2] == Point{1, 1, 0});
  CHECK(mesh.node_name(2) == "N3");
  CHECK(mesh.cell_name(2) == "M3");
  CHECK(Group(mesh.cell(2).begin(), mesh.cell(2).end()) == Group{0, 2, 3});
  CHECK(mesh.cell_group("PLATE") == Group{1, 2});
  CHECK(mesh.node_group("PLATE") == Group{3});
  CHECK(mesh.cell_group("EDGE") == Group{0});
}

TEST_CASE("cells of a universal file stand type by type, lines first", "[io]") {
  std::string text = square;
  const std::string line =
      "         1        21         2         1         7         2\n"
      "         0         1         1\n         5         6\n";
  const std::string last = "         5         8         9\n";
  text.replace(text.find(line), line.size(), "");
  text.insert(text.find(last) + last.size(), line);
  const Mesh mesh = parse_ideas_mesh(text, "square.unv");
  CHECK(mesh.cell_types == std::vector<CellType>{CellType::seg2, CellType::tria3, CellType::tria3});
  CHECK(mesh.cell_group("EDGE") == Group{0});
  CHECK(mesh.cell_group("PLATE") == Group{1, 2});
}

TEST_CASE("a data set may end behind the last member of a group, on the same line", "[io]") {
  const std::string edge = "         8         1         0         0\n    -1\n";
  std::string text = square;
  text.replace(text.size() - edge.size(), edge.size(),
               "         8         1         0         0    -1\n    -1\n  2467\n         3         0         0         "
               "0         0         0         0         1\nCORNER\n"
               "         7         5         0         0    -1\n");
  const Mesh mesh = parse_ideas_mesh(text, "square.unv");
  CHECK(mesh.cell_group("EDGE") == Group{0});
  CHECK(mesh.node_group("CORNER") == Group{0});
}

TEST_CASE("middle nodes stand between corners in a universal file, layer by layer", "[io]") {
  const Point a = {0, 0, 0}, b = {2, 0, 0}, c = {2, 3, 0}, d = {0, 3, 0}, e = {0, 0, 4}, f = {2, 0, 4}, g = {2, 3, 4},
              h = {0, 3, 4};
  std::vector<Point> line, tria, quad, tetra, penta, hexa;
  add_ring(line, {a, b}, false);
  add_ring(tria, {a, b, c});
  add_ring(quad, {a, b, c, d});
  add_ring(tetra, {a, b, c});
  tetra.insert(tetra.end(), {between(a, e), between(b, e), between(c, e), e});
  add_ring(penta, {a, b, c});
  penta.insert(penta.end(), {between(a, e), between(b, f), between(c, g)});
  add_ring(penta, {e, f, g});
  add_ring(hexa, {a, b, c, d});
  hexa.insert(hexa.end(), {between(a, e), between(b, f), between(c, g), between(d, h)});
  add_ring(hexa, {e, f, g, h});
  const std::vector<std::tuple<int, CellType, std::vector<Point>>> cases = {
      {24, CellType::seg3, line},      {92, CellType::tria6, tria},     {45, CellType::quad8, quad},
      {118, CellType::tetra10, tetra}, {113, CellType::penta15, penta}, {116, CellType::hexa20, hexa}};
  for (const auto& [descriptor, type, places] : cases) {
    CAPTURE(name_of(type));
    const Mesh mesh = parse_ideas_mesh(single(descriptor, places), "cell.unv");
    REQUIRE(mesh.cell_types.front() == type);
    const auto nodes = mesh.cell(0);
    const auto at = [&](int local) {
      return mesh.nodes[static_cast<std::size_t>(nodes[static_cast<std::size_t>(local)])];
    };
    CHECK(at(0) == a);
    CHECK(at(1) == b);
    const auto edges = middle_edges(type);
    for (std::size_t i = 0; i < edges.size(); ++i)
      CHECK(at(corner_count(type) + static_cast<int>(i)) == between(at(edges[i][0]), at(edges[i][1])));
  }
}

TEST_CASE("a universal file with a mistake is refused with its line", "[io]") {
  const auto refused = [](const std::string& text) {
    try {
      parse_ideas_mesh(text, "f.unv");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK_THAT(refused("    -1\n  2411\n  1 1 1 1\n 0. 0.\n    -1\n"), Catch::Contains("f.unv:4"));
  CHECK_THAT(refused(square.substr(0, square.size() - 10)), Catch::Contains("end"));
  CHECK_THAT(refused(single(999, {{0, 0, 0}})), Catch::Contains("kind 999"));
  CHECK_THAT(refused(""), Catch::Contains("no nodes"));
}

}  // namespace ideas_mesh_file_test
