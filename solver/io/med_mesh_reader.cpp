// Reading a mesh from a MED file.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "solver/error.hpp"
#include "solver/io/med_file.hpp"
#include "solver/io/med_library.hpp"
#include "solver/io/med_sanity.hpp"
#include "solver/mesh/flatness.hpp"

namespace comma::solver {
namespace {

struct MeshHeader {
  std::string name;
  med_int space_dimension = 0;
  med_mesh_type type = MED_UNDEF_MESH_TYPE;
  med_int step_count = 0;
};

/// One mesh of an open file at one of its computation steps.
class Reader {
 public:
  Reader(const MedFile& file, const MeshHeader& header) : file_(file), header_(header) { find_step(); }

  Mesh read();

 private:
  [[noreturn]] void damaged(const std::string& what) const {
    throw Error("damaged-mesh", fmt::format("{}: mesh {}: {}", file_.path(), header_.name, what));
  }

  void find_step();
  med_int count(med_entity_type entity, med_geometry_type geometry, med_data_type data) const;
  std::vector<CellType> types_present() const;
  void read_nodes(Mesh& mesh) const;
  void read_cells(Mesh& mesh, CellType type);
  std::vector<med_int> read_families(med_entity_type entity, med_geometry_type geometry, med_int entities) const;
  /// The number of each family and its groups, in the order of the file.
  std::vector<std::pair<med_int, std::vector<std::string>>> read_family_groups() const;
  void fill_groups(Mesh& mesh) const;

  const MedFile& file_;
  MeshHeader header_;
  med_int dt_ = MED_NO_DT;
  med_int it_ = MED_NO_IT;
  std::vector<med_int> node_families_;
  std::vector<med_int> cell_families_;
};

/// The step without time if there is one, else the first: a mesh that moves is read where it starts.
void Reader::find_step() {
  for (med_int step = 1; step <= header_.step_count; ++step) {
    med_int dt = MED_NO_DT;
    med_int it = MED_NO_IT;
    med_float time = 0.0;
    if (MEDmeshComputationStepInfo(file_.id(), header_.name.c_str(), step, &dt, &it, &time) < 0) {
      damaged(fmt::format("step {} cannot be read", step));
    }
    if (step == 1 || (dt == MED_NO_DT && it == MED_NO_IT)) std::tie(dt_, it_) = std::pair(dt, it);
  }
}

med_int Reader::count(med_entity_type entity, med_geometry_type geometry, med_data_type data) const {
  med_bool changed = MED_FALSE;
  med_bool transformed = MED_FALSE;
  const med_connectivity_mode mode = data == MED_CONNECTIVITY ? MED_NODAL : MED_NO_CMODE;
  return MEDmeshnEntity(file_.id(), header_.name.c_str(), dt_, it_, entity, geometry, data, mode, &changed,
                        &transformed);
}

std::vector<CellType> Reader::types_present() const {
  const med_int geometries = count(MED_CELL, MED_GEO_ALL, MED_CONNECTIVITY);
  if (geometries < 0) damaged("the cell types cannot be read");
  std::vector<CellType> types;
  for (med_int i = 1; i <= geometries; ++i) {
    std::array<char, MED_NAME_SIZE + 1> name{};
    med_geometry_type geometry = MED_NONE;
    if (MEDmeshEntityInfo(file_.id(), header_.name.c_str(), dt_, it_, MED_CELL, i, name.data(), &geometry) < 0) {
      damaged(fmt::format("cell type {} of {} cannot be read", i, geometries));
    }
    const auto type = cell_type_of(geometry);
    if (!type) {
      throw Error("unsupported-cell", fmt::format("{}: mesh {} has cells of type {}, which are not supported",
                                                  file_.path(), header_.name, trimmed(name.data())));
    }
    types.push_back(*type);
  }
  return types;
}

void Reader::read_nodes(Mesh& mesh) const {
  const med_int nodes = count(MED_NODE, MED_NO_GEOTYPE, MED_COORDINATE);
  if (nodes <= 0) damaged("it has no nodes");
  const auto dimension = static_cast<std::size_t>(header_.space_dimension);
  std::vector<med_float> coordinates(static_cast<std::size_t>(nodes) * dimension);
  if (MEDmeshNodeCoordinateRd(file_.id(), header_.name.c_str(), dt_, it_, MED_FULL_INTERLACE, coordinates.data()) < 0) {
    damaged("the coordinates of the nodes cannot be read");
  }
  mesh.dimension = dimension == 3 ? 3 : 2;
  mesh.nodes.assign(static_cast<std::size_t>(nodes), Point{});
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    std::copy_n(coordinates.begin() + static_cast<std::ptrdiff_t>(i * dimension), dimension, mesh.nodes[i].begin());
  }
}

void Reader::read_cells(Mesh& mesh, CellType type) {
  const med_geometry_type geometry = med_geometry(type);
  const med_int cells = count(MED_CELL, geometry, MED_CONNECTIVITY);
  if (cells < 0) damaged(fmt::format("the number of {} cells cannot be read", name_of(type)));
  const auto size = static_cast<std::size_t>(node_count(type));
  std::vector<med_int> connectivity(static_cast<std::size_t>(cells) * size);
  if (MEDmeshElementConnectivityRd(file_.id(), header_.name.c_str(), dt_, it_, MED_CELL, geometry, MED_NODAL,
                                   MED_FULL_INTERLACE, connectivity.data()) < 0) {
    damaged(fmt::format("the nodes of the {} cells cannot be read", name_of(type)));
  }
  const auto order = med_node_order(type);
  std::vector<int> cell(size);
  for (med_int i = 0; i < cells; ++i) {
    const med_int* nodes = connectivity.data() + static_cast<std::size_t>(i) * size;
    for (std::size_t j = 0; j < size; ++j) {
      const med_int node = nodes[order.empty() ? j : static_cast<std::size_t>(order[j])];
      if (node < 1 || node > mesh.node_count()) {
        damaged(fmt::format("{} cell {} refers to node {}, but there are {} nodes", name_of(type), i + 1, node,
                            mesh.node_count()));
      }
      cell[j] = node - 1;
    }
    mesh.add_cell(type, cell);
  }
  const auto families = read_families(MED_CELL, geometry, cells);
  cell_families_.insert(cell_families_.end(), families.begin(), families.end());
}

std::vector<med_int> Reader::read_families(med_entity_type entity, med_geometry_type geometry, med_int entities) const {
  std::vector<med_int> families(static_cast<std::size_t>(entities), 0);
  const med_int stored = count(entity, geometry, MED_FAMILY_NUMBER);
  if (stored <= 0) return families;  // no families stored: everything is in family 0
  if (stored != entities) damaged("the family numbers are not as many as the nodes or cells that they belong to");
  if (MEDmeshEntityFamilyNumberRd(file_.id(), header_.name.c_str(), dt_, it_, entity, geometry, families.data()) < 0) {
    damaged("the family numbers cannot be read");
  }
  return families;
}

std::vector<std::pair<med_int, std::vector<std::string>>> Reader::read_family_groups() const {
  med_int major = 0;
  med_int minor = 0;
  med_int release = 0;
  MEDfileNumVersionRd(file_.id(), &major, &minor, &release);
  const char* mesh = header_.name.c_str();
  std::vector<std::pair<med_int, std::vector<std::string>>> result;
  const med_int families = MEDnFamily(file_.id(), mesh);
  for (med_int i = 1; i <= families; ++i) {
    const med_int groups = MEDnFamilyGroup(file_.id(), mesh, i);
    const med_int attributes = major < 3 ? MEDnFamily23Attribute(file_.id(), mesh, i) : 0;
    if (groups < 0 || attributes < 0) damaged(fmt::format("family {} cannot be read", i));
    std::array<char, MED_NAME_SIZE + 1> name{};
    std::vector<char> names(static_cast<std::size_t>(groups) * MED_LNAME_SIZE + 1);
    std::vector<med_int> identifiers(static_cast<std::size_t>(attributes) + 1);
    std::vector<med_int> values(static_cast<std::size_t>(attributes) + 1);
    std::vector<char> descriptions(static_cast<std::size_t>(attributes) * MED_COMMENT_SIZE + 1);
    med_int number = 0;
    const med_err failed = major < 3 ? MEDfamily23Info(file_.id(), mesh, i, name.data(), identifiers.data(),
                                                       values.data(), descriptions.data(), &number, names.data())
                                     : MEDfamilyInfo(file_.id(), mesh, i, name.data(), &number, names.data());
    if (failed < 0) damaged(fmt::format("family {} cannot be read", i));
    auto& own = result.emplace_back(number, std::vector<std::string>()).second;
    for (med_int group = 0; group < groups; ++group) {
      own.push_back(trimmed({names.data() + static_cast<std::size_t>(group) * MED_LNAME_SIZE, MED_LNAME_SIZE}));
    }
  }
  return result;
}

void Reader::fill_groups(Mesh& mesh) const {
  const auto in_file = read_family_groups();
  std::map<med_int, std::vector<std::string>> groups_of;
  for (const auto& [number, names] : in_file) std::ranges::copy(names, std::back_inserter(groups_of[number]));
  const auto fill = [&](const std::vector<med_int>& families, Groups& groups) {
    const std::set<med_int> used(families.begin(), families.end());
    for (const auto& [number, names] : in_file)
      if (used.contains(number))
        for (const std::string& name : names) groups.try_emplace(name);
    for (std::size_t i = 0; i < families.size(); ++i) {
      const auto found = groups_of.find(families[i]);
      if (found == groups_of.end()) continue;
      for (const std::string& name : found->second) {
        auto& members = groups[name];
        if (members.empty() || members.back() != static_cast<int>(i)) members.push_back(static_cast<int>(i));
      }
    }
  };
  fill(node_families_, mesh.node_groups);
  fill(cell_families_, mesh.cell_groups);
}

Mesh Reader::read() {
  if (header_.type != MED_UNSTRUCTURED_MESH) {
    throw Error("unsupported",
                fmt::format("{}: mesh {} is a structured grid, which is not supported", file_.path(), header_.name));
  }
  if (header_.space_dimension < 1 || header_.space_dimension > 3) {
    damaged(fmt::format("its dimension is {}", header_.space_dimension));
  }
  Mesh mesh;
  read_nodes(mesh);
  node_families_ = read_families(MED_NODE, MED_NO_GEOTYPE, mesh.node_count());
  const auto present = types_present();
  for (const CellType type : numbering_order()) {
    if (std::ranges::find(present, type) != present.end()) read_cells(mesh, type);
  }
  fill_groups(mesh);
  settle_in_plane(mesh);
  return mesh;
}

std::vector<MeshHeader> read_headers(const MedFile& file) {
  const auto damaged = [&](const std::string& what) {
    throw Error("damaged-mesh", fmt::format("{}: {}", file.path(), what));
  };
  const med_int meshes = MEDnMesh(file.id());
  if (meshes < 0) damaged("the list of meshes cannot be read");
  std::vector<MeshHeader> headers;
  for (med_int i = 1; i <= meshes; ++i) {
    const med_int axes = MEDmeshnAxis(file.id(), i);
    if (axes < 0 || axes > 3) damaged(fmt::format("the dimension of mesh {} cannot be read", i));
    std::array<char, MED_NAME_SIZE + 1> name{};
    std::array<char, MED_COMMENT_SIZE + 1> description{};
    std::array<char, MED_LNAME_SIZE + 1> time_unit{};
    std::array<char, 3 * MED_SNAME_SIZE + 1> axis_names{};
    std::array<char, 3 * MED_SNAME_SIZE + 1> axis_units{};
    med_int mesh_dimension = 0;
    med_sorting_type sorting = MED_SORT_UNDEF;
    med_axis_type axis = MED_UNDEF_AXIS_TYPE;
    MeshHeader header;
    if (MEDmeshInfo(file.id(), i, name.data(), &header.space_dimension, &mesh_dimension, &header.type,
                    description.data(), time_unit.data(), &sorting, &header.step_count, &axis, axis_names.data(),
                    axis_units.data()) < 0) {
      damaged(fmt::format("the header of mesh {} cannot be read", i));
    }
    if (axes != header.space_dimension)
      damaged(fmt::format("mesh {} has {} axes but dimension {}", i, axes, header.space_dimension));
    header.name = trimmed(name.data());
    headers.push_back(std::move(header));
  }
  return headers;
}

const MeshHeader& choose(const std::vector<MeshHeader>& headers, const std::string& name, const std::string& path) {
  if (headers.empty()) throw Error("unknown-mesh", fmt::format("{}: the file holds no mesh", path));
  if (name.empty()) return headers.front();
  const auto found = std::ranges::find(headers, name, &MeshHeader::name);
  if (found != headers.end()) return *found;
  std::vector<std::string> names;
  for (const MeshHeader& header : headers) names.push_back(header.name);
  throw Error("unknown-mesh", fmt::format("{}: the file has no mesh {}", path, name),
              fmt::format("its meshes are: {}", fmt::join(names, ", ")));
}

}  // namespace

Mesh read_med_mesh(const std::string& path, const std::string& name) {
  const MedFile file = MedFile::open_for_reading(path);
  check_med_arrays(file);
  const auto headers = read_headers(file);
  return Reader(file, choose(headers, name, path)).read();
}

}  // namespace comma::solver
