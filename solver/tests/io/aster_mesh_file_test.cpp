#include "solver/io/aster_mesh_file.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <random>

#include "solver/error.hpp"
#include "solver/tests/mesh/reference_cells.hpp"
#include "temporary_file.hpp"

using namespace comma::solver;

namespace {

constexpr const char* square = R"(TITRE
  A square, 100% "free" text = with any sign, FIN
FINSF
%
COOR_2D   NOM=INDEFINI  NBOBJ=4   NBLIGE=2
          DATE=13/11/95 AUTEUR=SOMEONE
 A   0.  0    % the origin
 B   1.D0 .0E+0,  C 10.D-1
                    +1
 D, 0, 1.e0
FINSF
GROUP_NO  NOM = LOWER
 A B
FINSF
QUAD4
 S1 A B C D
FINSF
SEG2
 L1 A B   L2 B
 C
FINSF
GROUP_MA
 SIDES L1
 L2 L1
FINSF
GROUP_NO
 UPPER
 D C
FINSF
FIN
anything after the end
)";

std::string error_of(const std::string& text) {
  try {
    parse_aster_mesh(text, "x.mail");
  } catch (const Error& error) {
    return error.code() + " | " + error.what() + (error.hint().empty() ? "" : " | " + error.hint());
  }
  return "no error";
}

}  // namespace

TEST_CASE("names that another node or cell has afterwards are told") {
  const std::string head = "COOR_2D\nN1 0 0\n", tail = " 1 1\nFINSF\nPOI1\n";
  std::optional<MisleadingName> found;
  parse_aster_mesh(head + "N3 1 0\nN2" + tail + "M1 N1\nFINSF\nFIN", "x.mail", &found);
  REQUIRE(found);
  CHECK(found->in_file == "N2");
  CHECK(found->afterwards == "N3");
  parse_aster_mesh(head + "N2 1 0\nA" + tail + "M2 N1\nM1 A\nFINSF\nFIN", "x.mail", &found);
  REQUIRE(found);
  CHECK(found->in_file == "M1");
  CHECK(found->afterwards == "M2");
  parse_aster_mesh(head + "N2 1 0\nN7" + tail + "M1 N7\nFINSF\nFIN", "x.mail", &found);
  CHECK_FALSE(found);
}

TEST_CASE("a mesh file in free format is read") {
  const Mesh mesh = parse_aster_mesh(square, "x.mail");
  CHECK(mesh.dimension == 2);
  CHECK(mesh.nodes == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  CHECK(mesh.cell_types == std::vector{CellType::quad4, CellType::seg2, CellType::seg2});
  CHECK(mesh.connectivity == std::vector{0, 1, 2, 3, 0, 1, 1, 2});
  CHECK(mesh.node_groups.at("LOWER") == std::vector{0, 1});
  CHECK(mesh.node_groups.at("UPPER") == std::vector{3, 2});
  CHECK(mesh.cell_groups.at("SIDES") == std::vector{1, 2});
  CHECK(mesh.cell_name(0) == "M1");
}

TEST_CASE("faces in the plane Z = 0 lie in two dimensions, and lines in as many as the file says") {
  const auto dimension_of = [](const std::string& cells, const std::string& height) {
    return parse_aster_mesh("COOR_3D\nA 0 0 0\nB 1 0 0\nC 0 1 " + height + "\nFINSF\n" + cells + "\nFINSF\nFIN",
                            "x.mail")
        .dimension;
  };
  CHECK(dimension_of("TRIA3\nT A B C", "0") == 2);
  CHECK(dimension_of("TRIA3\nT A B C", "0.1") == 3);
  CHECK(dimension_of("SEG2\nS A B", "0") == 3);
}

TEST_CASE("sub-files may come in any order, and lines end in any way") {
  const Mesh mesh = parse_aster_mesh("POI1\r\nP N1\r\nFINSF\r\nCOOR_3D\r\nN1 1 2 3\r\nFINSF\r\nFIN", "x.mail");
  CHECK(mesh.dimension == 3);
  CHECK(mesh.nodes == std::vector<Point>{{1, 2, 3}});
  CHECK(mesh.cell_types == std::vector{CellType::poi1});
}

TEST_CASE("a mesh with every cell type comes back from its text") {
  Mesh mesh = tests::mesh_of_reference_cells();
  mesh.nodes[3][0] = 1.0 / 3.0 * 1e-300;
  mesh.node_groups["PATH"] = {5, 2, 9};
  mesh.cell_groups["ALL"] = {0, 3, 2, 1};
  const std::string text = format_aster_mesh(mesh);
  const Mesh read = parse_aster_mesh(text, "x.mail");
  CHECK(read.nodes == mesh.nodes);
  CHECK(read.cell_types == mesh.cell_types);
  CHECK(read.connectivity == mesh.connectivity);
  CHECK(read.node_groups == mesh.node_groups);
  CHECK(read.cell_groups == mesh.cell_groups);
  CHECK(format_aster_mesh(read) == text);
}

TEST_CASE("errors in a mesh file say where they are") {
  const std::string nodes = "COOR_2D\n N1 0. 0.\n N2 1. 0.\nFINSF\n";
  CHECK(error_of("") == "damaged-mesh | x.mail: the file is cut off: it ends without FIN");
  CHECK(error_of("FIN\n") == "damaged-mesh | x.mail: the mesh has no nodes: COOR_2D or COOR_3D is missing");
  CHECK(error_of(nodes) == "damaged-mesh | x.mail: the file is cut off: it ends without FIN");
  CHECK(error_of(nodes + "SEG2\n M1 N1 N2\nFIN\n") ==
        "damaged-mesh | x.mail:5:1: SEG2 has no FINSF: the file is cut off, or the line is missing");
  CHECK(error_of("COOR_2D\n N1 0. 0.\n  N2 1.\nFINSF\nFIN\n") ==
        "damaged-mesh | x.mail:3:3: node N2 lacks some of its 2 coordinates");
  CHECK(error_of("COOR_2D\n N1 0. 0,5x\nFINSF\nFIN\n") ==
        "damaged-mesh | x.mail:2:10: node 5x lacks some of its 2 coordinates");
  CHECK(error_of("COOR_2D\n N1 0. N2\nFINSF\nFIN\n") ==
        "damaged-mesh | x.mail:2:8: a coordinate is expected here, not N2");
  CHECK(error_of("COOR_2D\n N1 0. 1e999\nFINSF\nFIN\n") ==
        "damaged-mesh | x.mail:2:8: the number 1e999 is out of range");
  CHECK(error_of("COOR_2D\n N1 0. nan\nFINSF\nFIN\n") ==
        "damaged-mesh | x.mail:2:8: a coordinate is expected here, not nan");
  CHECK(error_of("COOR_2D\n N1 0. 1.\n N1 1. 1.\nFINSF\nFIN\n") ==
        "damaged-mesh | x.mail:3:2: node N1 is defined twice");
  CHECK(error_of(nodes + "SEG2\n M1 N1 N3\nFINSF\nFIN\n") ==
        "unknown-node | x.mail:6:8: there is no node N3 | did you mean N1?");
  CHECK(error_of(nodes + "SEG2\n M1 N1\nFINSF\nFIN\n") ==
        "damaged-mesh | x.mail:6:2: cell M1 lacks some of its 2 nodes");
  CHECK(error_of(nodes + "GROUP_MA\n G1 M7\nFINSF\nFIN\n") == "unknown-cell | x.mail:6:5: there is no cell M7");
  CHECK(error_of(nodes + "GROUP_NO\nFINSF\nFIN\n") == "damaged-mesh | x.mail:5:1: GROUP_NO lacks its name");
  CHECK(error_of(nodes + "GROUP_NO NOM=\n N1\nFINSF\nFIN\n") == "damaged-mesh | x.mail:5:13: NOM= lacks its name");
  CHECK(error_of(nodes + "GROUP_NO\nG N1\nFINSF\nGROUP_NO\nG N1\nFINSF\nFIN\n") ==
        "damaged-mesh | x.mail:8:1: GROUP_NO G is defined twice");
  CHECK(error_of(nodes + "SEG22\n M1 N1 N2\nFINSF\nFIN\n") ==
        "unsupported-cell | x.mail:5:1: cells of type SEG22 are not supported");
  CHECK(error_of(nodes + "GROUPE_NO\n G N1\nFINSF\nFIN\n") ==
        "damaged-mesh | x.mail:5:1: GROUPE_NO is not a keyword of a mesh file | did you mean GROUP_NO?");
  CHECK(error_of(nodes + "COOR_3D\n N3 1 2 3\nFINSF\nFIN\n") ==
        "damaged-mesh | x.mail:5:1: COOR_2D and COOR_3D cannot both be in one mesh");
  CHECK(
      error_of("COOR_2D\n" + std::string(70, ' ') + "N1 0.0 1.0 2.0\n") ==
      "damaged-mesh | x.mail:2:82: the line goes on beyond column 80, where Code_Aster stops reading | break the line");
  CHECK(error_of(std::string("COOR_2D\n N1 \0 0\nFINSF\nFIN\n", 27)) ==
        "damaged-mesh | x.mail:2:5: this is not a text file: there is a control character here");
}

TEST_CASE("a missing or empty mesh file is an error") {
  const tests::TemporaryFile file(".mail");
  CHECK_THROWS_AS(read_aster_mesh(file.path()), Error);
  CHECK_THROWS_WITH(read_aster_mesh("/dev/zero"), Catch::Contains("/dev/zero is not a regular file"));
  file.fill("");
  CHECK_THROWS_AS(read_aster_mesh(file.path()), Error);
  file.fill(square);
  CHECK(read_aster_mesh(file.path()).cell_count() == 3);
}

TEST_CASE("names that would not come back from a mesh file are refused") {
  Mesh mesh = parse_aster_mesh(square, "x.mail");
  mesh.node_groups["two words"] = {0};
  CHECK_THROWS_AS(format_aster_mesh(mesh), Error);
}

TEST_CASE("a damaged mesh file gives a mesh or an error, never worse") {
  const std::string whole(square);
  std::mt19937 random(7);  // fixed: a failure can be looked at
  const auto pick = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  static constexpr std::string_view pieces = " ,\n%=\t0.eEdDNFIS\x01\xff-+";
  const auto parse = [](const std::string& text) {
    try {
      const Mesh mesh = parse_aster_mesh(text, "x.mail");
      for (const int node : mesh.connectivity) REQUIRE((node >= 0 && node < mesh.node_count()));
      return true;
    } catch (const Error&) {
      return false;
    }
  };
  for (std::size_t length = 0; length < whole.find("\nFIN\n"); ++length) CHECK_FALSE(parse(whole.substr(0, length)));
  for (int round = 0; round < 3000; ++round) {
    std::string text = whole;
    for (std::size_t changes = 1 + pick(4); changes > 0; --changes) {
      const std::size_t at = pick(text.size());
      switch (pick(4)) {
        case 0:
          text[at] = pieces[pick(pieces.size())];
          break;
        case 1:
          text.erase(at, 1 + pick(20));
          break;
        case 2:
          text.insert(at, 1, pieces[pick(pieces.size())]);
          break;
        default:
          text.insert(at, whole.substr(pick(whole.size()), pick(30)));
          break;
      }
      if (text.empty()) text = "F";
    }
    parse(text);
  }
}
