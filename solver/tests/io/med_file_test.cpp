#include "solver/io/med_file.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>
#include <random>

#include "solver/error.hpp"
#include "solver/io/med_library.hpp"
#include "solver/io/med_localization.hpp"
#include "solver/tests/exactly.hpp"
#include "solver/tests/mesh/reference_cells.hpp"
#include "temporary_file.hpp"

using namespace comma::solver;
using comma::solver::tests::TemporaryFile;

namespace med_file_test {

std::string code_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    CHECK_FALSE(std::string(error.what()).empty());
    return error.code();
  }
  return "no error";
}

/// Two squares side by side, a bar and a point, with groups that overlap.
Mesh small_mesh() {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  mesh.add_cell(CellType::poi1, std::vector{2});
  mesh.add_cell(CellType::seg2, std::vector{0, 1});
  mesh.add_cell(CellType::quad4, std::vector{0, 1, 4, 3});
  mesh.add_cell(CellType::quad4, std::vector{1, 2, 5, 4});
  mesh.cell_groups["LEFT"] = {2};
  mesh.cell_groups["SQUARES"] = {2, 3};
  mesh.cell_groups["A group with a name of some length, up to the limit of MED, eighty characters !!"] = {1};
  mesh.node_groups["CORNERS"] = {0, 2, 3, 5};
  mesh.node_groups["ORIGIN"] = {0};
  return mesh;
}

void check_same(const Mesh& a, const Mesh& b) {
  CHECK(a.dimension == b.dimension);
  CHECK(a.nodes == b.nodes);
  CHECK(a.cell_types == b.cell_types);
  CHECK(a.cell_starts == b.cell_starts);
  CHECK(a.connectivity == b.connectivity);
  CHECK(a.node_groups == b.node_groups);
  CHECK(a.cell_groups == b.cell_groups);
}

Mesh rewritten(const Mesh& mesh) {
  const TemporaryFile file;
  write_med_mesh(file.path(), mesh, "MESH");
  return read_med_mesh(file.path());
}

TEST_CASE("MED node orders are permutations that turn solids inside out") {
  for (int i = 0; i < cell_type_count; ++i) {
    const auto type = static_cast<CellType>(i);
    const auto order = med_node_order(type);
    INFO(name_of(type));
    if (dimension(type) < 3) {
      CHECK(order.empty());
      continue;
    }
    std::vector<int> sorted(order.begin(), order.end());
    std::sort(sorted.begin(), sorted.end());
    for (int j = 0; j < node_count(type); ++j) CHECK(sorted[j] == j);
    // A MED cell read without the permutation has the opposite volume.
    Mesh mesh;
    std::vector<int> straight;
    const auto points = tests::reference_nodes(type);
    mesh.nodes.resize(points.size());
    for (std::size_t j = 0; j < points.size(); ++j) {
      const auto& point = points[j];
      mesh.nodes[static_cast<std::size_t>(order[j])] = {point.x(), point.y(), point.z()};
      straight.push_back(static_cast<int>(j));
    }
    mesh.add_cell(type, straight);
    CHECK(tests::solid_volume(mesh, 0) == Approx(-tests::reference_volume(type)).epsilon(1e-14));
  }
}

TEST_CASE("a mesh with every cell type comes back from a MED file") {
  const Mesh mesh = tests::mesh_of_reference_cells();
  const Mesh read = rewritten(mesh);
  REQUIRE(read.cell_count() == mesh.cell_count());
  CHECK(read.nodes == mesh.nodes);
  for (int cell = 0; cell < read.cell_count(); ++cell) {
    const CellType type = read.cell_types[cell];
    CHECK(type == numbering_order()[static_cast<std::size_t>(cell)]);
    const int original = static_cast<int>(type);
    CHECK(std::equal(read.cell(cell).begin(), read.cell(cell).end(), mesh.cell(original).begin()));
    if (dimension(type) == 3) CHECK(tests::solid_volume(read, cell) == exactly(tests::reference_volume(type)));
  }
}

TEST_CASE("faces in the plane Z = 0 lie in two dimensions, whatever the file says of the space around") {
  Mesh mesh = small_mesh();
  mesh.dimension = 3;
  CHECK(rewritten(mesh).dimension == 2);
  mesh.nodes[0][2] = 1e-3;
  CHECK(rewritten(mesh).dimension == 3);
  Mesh frame;
  frame.nodes = {{0, 0, 0}, {1, 0, 0}};
  frame.add_cell(CellType::seg2, std::vector{0, 1});
  CHECK(rewritten(frame).dimension == 3);
}

TEST_CASE("groups come back from a MED file") {
  const Mesh mesh = small_mesh();
  check_same(rewritten(mesh), mesh);
}

TEST_CASE("a mesh is chosen by its name") {
  const TemporaryFile file;
  write_med_mesh(file.path(), small_mesh(), "THIS");
  check_same(read_med_mesh(file.path(), "THIS"), small_mesh());
  try {
    read_med_mesh(file.path(), "THAT");
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.code() == "unknown-mesh");
    CHECK(error.hint() == "its meshes are: THIS");
  }
}

TEST_CASE("names that MED cannot hold are refused") {
  const TemporaryFile file;
  Mesh mesh = small_mesh();
  CHECK(code_of([&] { write_med_mesh(file.path(), mesh, std::string(65, 'M')); }) == "name-too-long");
  CHECK(code_of([&] { write_med_mesh(file.path(), mesh, "a/b"); }) == "invalid-name");
  CHECK(code_of([&] { write_med_mesh("/no/such/folder/x.med", mesh, "M"); }) == "unwritable-file");
  mesh.cell_groups[std::string(81, 'G')] = {0};
  CHECK(code_of([&] { write_med_mesh(file.path(), mesh, "M"); }) == "name-too-long");
}

TEST_CASE("a MED file of a later minor version is read as what it holds") {
  const TemporaryFile file;
  write_med_mesh(file.path(), small_mesh(), "MESH");
  const auto stamp = [&](const char* name, int version) {
    const hid_t open = H5Fopen(file.path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
                group = H5Gopen2(open, "INFOS_GENERALES", H5P_DEFAULT), number = H5Aopen(group, name, H5P_DEFAULT);
    REQUIRE(H5Awrite(number, H5T_NATIVE_INT, &version) >= 0);
    H5Aclose(number);
    H5Gclose(group);
    H5Fclose(open);
  };
  stamp("MIN", MED_MINOR_NUM + 1);
  const std::string before = file.bytes();
  check_same(read_med_mesh(file.path()), small_mesh());
  CHECK(file.bytes() == before);
  stamp("MAJ", MED_MAJOR_NUM + 1);
  CHECK(code_of([&] { read_med_mesh(file.path()); }) == "unreadable-file");
}

TEST_CASE("what is not a MED file is an error") {
  const TemporaryFile file;
  CHECK(code_of([&] { read_med_mesh(file.path()); }) == "unreadable-file");
  for (const char* content : {"", "COOR_2D\n", "\x89HDF\r\n\x1a\n"}) {
    file.fill(content);
    CHECK(code_of([&] { read_med_mesh(file.path()); }) == "unreadable-file");
  }
  CHECK(code_of([&] { read_med_mesh(std::filesystem::temp_directory_path().string()); }) == "unreadable-file");
}

TEST_CASE("a MED file cut off anywhere is an error") {
  const TemporaryFile file;
  write_med_mesh(file.path(), small_mesh(), "M");
  const std::string whole = file.bytes();
  const std::size_t step = whole.size() / 97;
  for (std::size_t length = 0; length < whole.size(); length += step) {
    file.fill(std::string_view(whole).substr(0, length));
    INFO(length);
    const std::string code = code_of([&] { read_med_mesh(file.path()); });
    CHECK((code == "unreadable-file" || code == "damaged-mesh"));
  }
}

TEST_CASE("a MED file with changed bytes gives a mesh or an error, never worse") {
  const TemporaryFile original;
  write_med_mesh(original.path(), small_mesh(), "M");
  const std::string whole = original.bytes();
  const TemporaryFile file;
  std::mt19937 random(11);  // fixed: a failure can be looked at
  for (int round = 0; round < 300; ++round) {
    std::string bytes = whole;
    for (int change = 0; change < 3; ++change)
      bytes[random() % bytes.size()] ^= static_cast<char>(1u << (random() % 8));
    file.fill(bytes);
    try {
      const Mesh mesh = read_med_mesh(file.path());
      for (const int node : mesh.connectivity) REQUIRE((node >= 0 && node < mesh.node_count()));
    } catch (const Error& error) {
      CHECK((error.code() == "unreadable-file" || error.code() == "damaged-mesh" || error.code() == "unsupported" ||
             error.code() == "unsupported-cell" || error.code() == "unknown-mesh"));
    }
  }
}

TEST_CASE("an array that claims more than its file can hold is an error, and takes no memory") {
  const TemporaryFile file;
  write_med_mesh(file.path(), small_mesh(), "M");
  const hid_t id = H5Fopen(file.path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  REQUIRE(id >= 0);
  // Two thousand million coordinates of which none is written: HDF5 would read zeros.
  std::string place;
  H5Ovisit2(
      id, H5_INDEX_NAME, H5_ITER_NATIVE,
      [](hid_t, const char* name, const H5O_info_t*, void* found) {
        if (std::string_view(name).ends_with("/COO")) *static_cast<std::string*>(found) = name;
        return herr_t{0};
      },
      &place, H5O_INFO_BASIC);
  REQUIRE_FALSE(place.empty());
  REQUIRE(H5Ldelete(id, place.c_str(), H5P_DEFAULT) >= 0);
  const long long nodes = 1'000'000'000;
  const hsize_t extent = 2 * nodes;
  const hsize_t chunk = 1024;
  const hid_t space = H5Screate_simple(1, &extent, nullptr);
  const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(layout, 1, &chunk);
  const hid_t array = H5Dcreate2(id, place.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, layout, H5P_DEFAULT);
  const hid_t single = H5Screate(H5S_SCALAR);
  const hid_t count = H5Acreate2(array, "NBR", H5T_NATIVE_LLONG, single, H5P_DEFAULT, H5P_DEFAULT);
  REQUIRE(H5Awrite(count, H5T_NATIVE_LLONG, &nodes) >= 0);
  H5Aclose(count);
  H5Sclose(single);
  H5Dclose(array);
  H5Pclose(layout);
  H5Sclose(space);
  H5Fclose(id);
  try {
    read_med_mesh(file.path());
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.code() == "damaged-mesh");
    CHECK_THAT(error.what(), Catch::Contains("more than the file can hold"));
  }
}

TEST_CASE("results are written with profiles and localisations") {
  const auto mesh = small_mesh();
  NodalField displacement{"DEPL_R", {"DX", "DY"}, std::vector<double>(12, 1.0)};
  displacement.values[10] = displacement.values[11] = absent;
  displacement.values[9] = absent;
  ElementField stress{"SIEF_R", Support::gauss_point, {"SIXX"}, {0, 0, 1, 5, 9}, std::vector<double>(9, 2.0)};
  ElementField corner{"SIEF_R", Support::element_node, {"SIXX"}, {0, 0, 0, 4, 4}, {1, 2, 3, 4}};
  ElementField mean{"ENER_R", Support::cell, {"TOTALE"}, {0, 0, 0, 1, 2}, {1, 2}};
  Result result;
  for (int order = 0; order < 2; ++order) {
    ResultStep step;
    step.order = order;
    step.instant = 0.5 * order;
    step.fields = {{"DEPL", displacement}, {"SIEF_ELGA", stress}, {"SIEF_ELNO", corner}, {"ENEL_ELEM", mean}};
    result.steps.push_back(step);
  }
  const TemporaryFile file;
  write_med_result(file.path(), mesh, "MESH", result, "RESU");
  check_same(read_med_mesh(file.path()), mesh);

  const MedFile med = MedFile::open_for_reading(file.path());
  CHECK(MEDnField(med.id()) == 4);
  CHECK(MEDnProfile(med.id()) == 2);  // nodes 1 to 5, and the first quadrangle
  CHECK(MEDnLocalization(med.id()) == 2);
  std::vector<double> values(10, -1.0);
  const med_err failed = MEDfieldValueWithProfileRd(
      med.id(), "RESU____DEPL", 1, MED_NO_IT, MED_NODE, MED_NO_GEOTYPE, MED_COMPACT_STMODE, "PROFILE_1",
      MED_FULL_INTERLACE, MED_ALL_CONSTITUENT, reinterpret_cast<unsigned char*>(values.data()));
  REQUIRE(failed >= 0);
  CHECK(values == std::vector<double>{1, 1, 1, 1, 1, 1, 1, 1, 1, 0});
}

TEST_CASE("a file takes further steps, results and meshes, and keeps what it has") {
  const auto mesh = small_mesh();
  Result result;
  const auto take_step = [&](int order, double value) {
    NodalField field{"DEPL_R", {"DX"}, std::vector<double>(6, value)};
    field.values[5] = absent;
    ElementField stress{"SIEF_R", Support::gauss_point, {"SIXX"}, {0, 0, 1, 5, 9}, std::vector<double>(9, value)};
    result.steps = {ResultStep{}};
    result.steps.front().order = order;
    result.steps.front().fields = {{"DEPL", field}, {"SIEF_ELGA", stress}};
  };
  const TemporaryFile file;
  take_step(1, 1.0);
  write_med_result(file.path(), mesh, "MESH", result, "FIRST");
  take_step(2, 2.0);
  add_med_results(file.path(), mesh, "MESH", true, std::vector<NamedResult>{{result, "FIRST"}, {result, "SECOND"}});
  add_med_results(file.path(), mesh, "OTHER", false, {});
  check_same(read_med_mesh(file.path(), "MESH"), mesh);
  check_same(read_med_mesh(file.path(), "OTHER"), mesh);
  const auto added = [&](const char* name, const char* field) {
    const std::vector<NamedResult> more = {{result, field}};
    add_med_results(file.path(), mesh, name, true, more);
  };
  CHECK(code_of([&] { added("OTHER", "FIRST"); }) == "unsupported");
  std::get<NodalField>(result.steps.front().fields["DEPL"]).components = {"DY"};
  CHECK(code_of([&] { added("MESH", "FIRST"); }) == "unsupported");

  const MedFile med = MedFile::open_for_reading(file.path());
  CHECK(MEDnField(med.id()) == 4);
  CHECK(MEDnLocalization(med.id()) == 2);
  for (const int order : {1, 2}) {
    std::vector<double> values(5, -1.0);
    REQUIRE(MEDfieldValueWithProfileRd(med.id(), "FIRST___DEPL", order, MED_NO_IT, MED_NODE, MED_NO_GEOTYPE,
                                       MED_COMPACT_STMODE, order == 1 ? "PROFILE_1" : "PROFILE_2", MED_FULL_INTERLACE,
                                       MED_ALL_CONSTITUENT, reinterpret_cast<unsigned char*>(values.data())) >= 0);
    CHECK(values == std::vector<double>(5, order));
  }
}

TEST_CASE("a field has the components that any of its steps has") {
  const auto mesh = small_mesh();
  Result result;
  for (int order = 0; order < 2; ++order) {
    ResultStep& step = result.steps.emplace_back();
    step.order = order;
    step.instant = order;
    const std::vector<std::string> names =
        order == 0 ? std::vector<std::string>{"V1"} : std::vector<std::string>{"V2", "V1"};
    step.fields = {{"VARI_NOEU", NodalField{"VARI_R", names, std::vector<double>(6 * names.size(), 1.0 + order)}}};
  }
  const TemporaryFile file;
  write_med_result(file.path(), mesh, "MESH", result, "RESU");
  const MedFile med = MedFile::open_for_reading(file.path());
  std::vector<double> values(12, -1.0);
  const auto read = [&](int order) {
    return MEDfieldValueWithProfileRd(med.id(), "RESU____VARI_NOEU", order, MED_NO_IT, MED_NODE, MED_NO_GEOTYPE,
                                      MED_COMPACT_STMODE, MED_NO_PROFILE, MED_FULL_INTERLACE, MED_ALL_CONSTITUENT,
                                      reinterpret_cast<unsigned char*>(values.data()));
  };
  REQUIRE(read(0) >= 0);
  CHECK(values == std::vector<double>{1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0});
  REQUIRE(read(1) >= 0);
  CHECK(values == std::vector<double>(12, 2.0));
}

TEST_CASE("a field that MED files cannot place is refused by name") {
  Result result;
  ResultStep step;
  step.fields["SIEF_ELGA"] =
      ElementField{"SIEF_R", Support::gauss_point, {"SIXX"}, {0, 0, 0, 7, 7}, std::vector<double>(7)};
  result.steps.push_back(step);
  const TemporaryFile file;
  CHECK(code_of([&] { write_med_result(file.path(), small_mesh(), "M", result, "R"); }) == "unsupported");
}

TEST_CASE("integration schemes sum up to the reference cell and lie inside it") {
  int found = 0;
  for (int i = 0; i < cell_type_count; ++i) {
    const auto type = static_cast<CellType>(i);
    for (int points = 1; points <= 27; ++points) {
      const auto scheme = gauss_scheme(type, points);
      if (!scheme) continue;
      ++found;
      INFO(name_of(type) << " " << points);
      REQUIRE(static_cast<int>(scheme->points.size()) == points);
      REQUIRE(static_cast<int>(scheme->weights.size()) == points);
      double sum = 0.0;
      for (const double weight : scheme->weights) sum += weight;
      const double size = type == CellType::poi1 ? 1.0 : tests::reference_volume(type);
      CHECK(sum == Approx(size).epsilon(1e-14));
    }
  }
  CHECK(found >= cell_type_count);
}

}  // namespace med_file_test
