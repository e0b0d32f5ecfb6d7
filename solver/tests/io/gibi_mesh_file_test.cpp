#include "solver/io/gibi_mesh_file.hpp"

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/mesh/reference_cell.hpp"

using namespace comma::solver;
using Group = std::vector<int>;

namespace {

// Two QUA8 side by side, in two objects that make up PLATE, their lower edge as SEG3 and two points as a mesh; an edge
// that nothing refers to; the second face once more. The points stand in another order than their coordinates.
const std::string plate = R"( ENREGISTREMENT DE TYPE   4
 NIVEAU  11 NIVEAU ERREUR   0 DIMENSION   2
 DENSITE 0.00000E+00
 ENREGISTREMENT DE TYPE   7
 NOMBRE INFO CASTEM2000   8
 IFOUR   2 NIFOUR   0 IFOMOD   2 IECHO   1 IIMPI   0 IOSPI   0 ISOTYP   1
 ENREGISTREMENT DE TYPE   2
 PILE NUMERO   1NBRE OBJETS NOMMES       4NBRE OBJETS       7
 PLATE    LOWER    ENDS     AGAIN
       1       4       5       7
       0       2       0       0       0
       2       3
      10       0       1       8       1
       4
       0
       1       2       3       4       5       6       7       8
      10       0       0       8       1
       0
       3       9      10      11      12      13       5       4
       3       0       0       3       2
       0       0
       1       2       3       3       9      10
       1       0       0       1       2
       0       0
       1      10
       3       0       0       3       1
       0
       5       4       3
      10       0       0       8       1
       0
       3       9      10      11      12      13       5       4
 ENREGISTREMENT DE TYPE   2
 PILE NUMERO  32NBRE OBJETS NOMMES       1NBRE OBJETS      13
 ORIGIN
       1
      13
       1       2       3       4       5       6       7       8       9      10
      11      13      12
 ENREGISTREMENT DE TYPE   2
 PILE NUMERO  33NBRE OBJETS NOMMES       0NBRE OBJETS       1
      39
 0.0E+00 0.0E+00 0.0E+00 0.5E+00 0.0E+00 0.0E+00 1.0E+00 0.0E+00 0.0E+00
 1.0E+00 0.5E+00 0.0E+00 1.0E+00 1.0E+00 0.0E+00 0.5E+00 1.0E+00 0.0E+00
 0.0E+00 1.0E+00 0.0E+00 0.0E+00 0.5E+00 0.0E+00 1.5E+00 0.0E+00 0.0E+00
 2.0E+00 0.0E+00 0.0E+00 2.0E+00 0.5E+00 0.0E+00 1.5E+00 1.0E+00 0.0E+00
 2.0E+00 1.0E+00 0.0E+00
 ENREGISTREMENT DE TYPE   5
LABEL AUTOMATIQUE :   1
)";

}  // namespace

TEST_CASE("a mesh of Cast3M is read with its named objects", "[io]") {
  const Mesh mesh = parse_gibi_mesh(plate, "plate.mgib");
  CHECK(mesh.dimension == 2);
  CHECK(mesh.node_count() == 13);
  CHECK(mesh.nodes[12] == Point{2, 1, 0});  // the point before the last: its coordinates stand last
  CHECK(mesh.cell_types == std::vector<CellType>{CellType::quad8, CellType::quad8, CellType::seg3, CellType::seg3,
                                                 CellType::poi1, CellType::poi1});
  CHECK(Group(mesh.cell(0).begin(), mesh.cell(0).end()) == Group{0, 2, 4, 6, 1, 3, 5, 7});
  CHECK(Group(mesh.cell(3).begin(), mesh.cell(3).end()) == Group{2, 9, 8});
  CHECK(mesh.cell_group("PLATE") == Group{0, 1});
  CHECK(mesh.cell_group("AGAIN") == Group{1});
  CHECK(mesh.cell_group("LOWER") == Group{2, 3});
  CHECK(mesh.cell_group("ENDS") == Group{4, 5});
  CHECK(mesh.node_group("ORIGIN") == Group{0});
  CHECK_FALSE(mesh.node_groups.contains("ENDS"));
}

TEST_CASE("a cell of Cast3M whose nodes stand in another order is another cell", "[io]") {
  std::string text = plate;
  const std::string cell = "       3       9      10      11      12      13       5       4";
  text.replace(text.rfind(cell), cell.size(), "      10      11      12      13       5       4       3       9");
  const Mesh mesh = parse_gibi_mesh(text, "plate.mgib");
  CHECK(mesh.cell_count() == 7);
  CHECK(mesh.cell_group("AGAIN") == Group{6});
}

TEST_CASE("nodes of a mesh of Cast3M are numbered as their places are, without those that no point takes", "[io]") {
  std::string text = plate;
  const std::string points =
      "       1       2       3       4       5       6       7       8       9      10\n"
      "      11      13      12";
  const std::string turned =
      "      14      13      12      11      10       9       8       7       6       5\n"
      "       4       2       3";
  text.replace(text.find(points, text.find("PILE NUMERO  32")), points.size(), turned);
  text.replace(text.find("      39\n"), 9, "      42\n -1.0 -1.0 0.0\n");
  const Mesh mesh = parse_gibi_mesh(text, "plate.mgib");
  REQUIRE(mesh.node_count() == 13);
  CHECK(mesh.nodes[0] == Point{0, 0, 0});
  CHECK(mesh.nodes[12] == Point{2, 1, 0});
  CHECK(mesh.node_group("ORIGIN") == Group{12});
  CHECK(Group(mesh.cell(4).begin(), mesh.cell(4).end()) == Group{12});
}

TEST_CASE("a hexahedron of Cast3M goes round its levels, then over its faces", "[io]") {
  const std::vector<std::array<int, 2>> ring = {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}};
  std::vector<std::array<int, 3>> points;
  for (const auto& [x, y] : ring) points.push_back({x, y, -1});
  for (const int corner : {0, 2, 4, 6}) points.push_back({ring[corner][0], ring[corner][1], 0});
  for (const auto& [x, y] : ring) points.push_back({x, y, 1});
  for (const int side : {1, 3, 5, 7}) points.push_back({ring[side][0], ring[side][1], 0});
  points.insert(points.end(), {{0, 0, -1}, {0, 0, 1}, {0, 0, 0}});
  std::string cell, coordinates;
  for (std::size_t i = 0; i < points.size(); ++i) {
    cell += fmt::format(" {}", i + 1);
    coordinates += fmt::format(" {} {} {} 0", points[i][0], points[i][1], points[i][2]);
  }
  const std::string text =
      " ENREGISTREMENT DE TYPE   4\n NIVEAU  11 NIVEAU ERREUR   0 DIMENSION   3\n ENREGISTREMENT DE TYPE   2\n"
      " PILE NUMERO   1NBRE OBJETS NOMMES       1NBRE OBJETS       1\n BLOCK\n 1\n 33 0 0 27 1\n 0\n" +
      cell + "\n ENREGISTREMENT DE TYPE   2\n PILE NUMERO  32NBRE OBJETS NOMMES       0NBRE OBJETS      27\n 27\n" +
      cell + "\n ENREGISTREMENT DE TYPE   2\n PILE NUMERO  33NBRE OBJETS NOMMES       0NBRE OBJETS       1\n 108\n" +
      coordinates + "\n ENREGISTREMENT DE TYPE   5\n";
  const Mesh mesh = parse_gibi_mesh(text, "block.mgib");
  const auto expected = reference_points(CellType::hexa27);
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(mesh.nodes[static_cast<std::size_t>(mesh.cell(0)[i])] == expected[i]);
}

TEST_CASE("a damaged file of Cast3M is an error with its place", "[io]") {
  const std::size_t whole = plate.find("LABEL");
  for (std::size_t length = 0; length + 2 < whole; length += 5) {
    CAPTURE(length);
    CHECK_THROWS_AS(parse_gibi_mesh(plate.substr(0, length), "plate.mgib"), Error);
  }
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = plate;
    return text.replace(text.find(from), from.size(), to);
  };
  CHECK_THROWS_WITH(parse_gibi_mesh(with("10       0       1       8", "99       0       1       8"), "plate.mgib"),
                    Catch::Contains("plate.mgib:14:8") && Catch::Contains("type 99 are not known"));
  CHECK_THROWS_WITH(parse_gibi_mesh(with("10       0       1       8", "10       0       1       7"), "plate.mgib"),
                    Catch::Contains("has 8 nodes, not 7"));
  CHECK_THROWS_WITH(parse_gibi_mesh(with("       2       3\n", "       2       9\n"), "plate.mgib"),
                    Catch::Contains("not between 1 and 7"));
  CHECK_THROWS_WITH(parse_gibi_mesh(with("      11      13      12", "      11      14      12"), "plate.mgib"),
                    Catch::Contains("coordinates of place 14, where a point lies, are missing"));
  CHECK_THROWS_WITH(parse_gibi_mesh(with("      1      10\n", "      1      14\n"), "plate.mgib"),
                    Catch::Contains("no point 14"));
  CHECK_THROWS_WITH(parse_gibi_mesh(with("DIMENSION   2", "DIMENSION   4"), "plate.mgib"),
                    Catch::Contains("the dimension is 4"));
}
