#include "solver/io/med_mesh_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "solver/error.hpp"
#include "solver/io/med_file.hpp"

namespace comma::solver {
namespace {

/// MED's partition of the nodes (or cells) by the groups they are in: a family is a set of groups, and each node is in
/// one family. Nodes have positive family numbers, cells negative ones, and 0 stands for no group.
struct Families {
  std::vector<med_int> of_entity;
  std::vector<std::vector<std::string>> groups;  ///< of family i+1, or -(i+1)
};

Families partition(const auto& groups, int entities) {
  std::vector<std::vector<std::string>> groups_of(static_cast<std::size_t>(entities));
  for (const auto& [name, members] : groups) {
    for (const int member : members) groups_of[static_cast<std::size_t>(member)].push_back(name);
  }
  Families families;
  std::map<std::vector<std::string>, med_int> numbers = {{{}, 0}};
  for (const auto& names : groups_of) {
    const auto [entry, is_new] = numbers.try_emplace(names, static_cast<med_int>(families.groups.size()) + 1);
    if (is_new) families.groups.push_back(names);
    families.of_entity.push_back(entry->second);
  }
  return families;
}

void write_families(const MedFile& file, const std::string& mesh, const Families& families, int sign) {
  for (std::size_t i = 0; i < families.groups.size(); ++i) {
    const auto& groups = families.groups[i];
    const auto number = static_cast<med_int>(sign * (static_cast<int>(i) + 1));
    check_written(MEDfamilyCr(file.id(), mesh.c_str(), fmt::format("FAM_{}", number).c_str(), number,
                              static_cast<med_int>(groups.size()), padded(groups, MED_LNAME_SIZE).c_str()),
                  file, "a family");
  }
}

void write_nodes(const MedFile& file, const Mesh& mesh, const std::string& name, const Families& families) {
  const auto dimension = static_cast<std::size_t>(mesh.dimension);
  std::vector<med_float> coordinates;
  for (const Point& point : mesh.nodes) {
    coordinates.insert(coordinates.end(), point.begin(), point.begin() + static_cast<std::ptrdiff_t>(dimension));
  }
  check_written(MEDmeshNodeCoordinateWr(file.id(), name.c_str(), MED_NO_DT, MED_NO_IT, MED_UNDEF_DT, MED_FULL_INTERLACE,
                                        mesh.node_count(), coordinates.data()),
                file, "the coordinates");
  check_written(MEDmeshEntityFamilyNumberWr(file.id(), name.c_str(), MED_NO_DT, MED_NO_IT, MED_NODE, MED_NO_GEOTYPE,
                                            mesh.node_count(), families.of_entity.data()),
                file, "the families of the nodes");
}

void write_names(const MedFile& file, const std::string& mesh, med_entity_type entity, med_geometry_type geometry,
                 const std::vector<std::string>& names) {
  check_written(MEDmeshEntityNameWr(file.id(), mesh.c_str(), MED_NO_DT, MED_NO_IT, entity, geometry,
                                    static_cast<med_int>(names.size()), padded(names, MED_SNAME_SIZE).c_str()),
                file, "the names of nodes or cells");
}

void write_block(const MedFile& file, const Mesh& mesh, const std::string& name, const MedBlock& block,
                 const Families& families) {
  const auto order = med_node_order(block.type);
  const med_geometry_type geometry = med_geometry(block.type);
  const auto count = static_cast<med_int>(block.cells.size());
  std::vector<med_int> connectivity;
  std::vector<med_int> family_numbers;
  std::vector<std::string> names;
  for (const int cell : block.cells) {
    const auto nodes = mesh.cell(cell);
    const std::size_t start = connectivity.size();
    connectivity.resize(start + nodes.size());
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      connectivity[start + (order.empty() ? j : static_cast<std::size_t>(order[j]))] = nodes[j] + 1;
    }
    family_numbers.push_back(-families.of_entity[static_cast<std::size_t>(cell)]);
    if (!mesh.cell_names.empty()) names.push_back(mesh.cell_names[static_cast<std::size_t>(cell)]);
  }
  check_written(MEDmeshElementConnectivityWr(file.id(), name.c_str(), MED_NO_DT, MED_NO_IT, MED_UNDEF_DT, MED_CELL,
                                             geometry, MED_NODAL, MED_FULL_INTERLACE, count, connectivity.data()),
                file, "the cells");
  check_written(MEDmeshEntityFamilyNumberWr(file.id(), name.c_str(), MED_NO_DT, MED_NO_IT, MED_CELL, geometry, count,
                                            family_numbers.data()),
                file, "the families of the cells");
  if (!names.empty()) write_names(file, name, MED_CELL, geometry, names);
}

void create_mesh(const MedFile& file, const Mesh& mesh, const std::string& name) {
  const std::vector<std::string> axes(std::initializer_list<std::string>{"X", "Y", "Z"});
  const std::vector<std::string> units(3);
  const auto used = static_cast<std::size_t>(mesh.dimension);
  int highest = 0;
  for (const CellType type : mesh.cell_types) highest = std::max(highest, dimension(type));
  const med_int mesh_dimension = mesh.cell_types.empty() ? mesh.dimension : std::min(highest, mesh.dimension);
  check_written(MEDmeshCr(file.id(), name.c_str(), mesh.dimension, mesh_dimension, MED_UNSTRUCTURED_MESH, "", "",
                          MED_SORT_DTIT, MED_CARTESIAN, padded(std::span(axes).first(used), MED_SNAME_SIZE).c_str(),
                          padded(std::span(units).first(used), MED_SNAME_SIZE).c_str()),
                file, "the mesh");
}

}  // namespace

std::vector<MedBlock> med_blocks(const Mesh& mesh) {
  std::vector<MedBlock> blocks;
  for (const CellType type : numbering_order()) {
    MedBlock block{type, {}};
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
      if (mesh.cell_types[cell] == type) block.cells.push_back(cell);
    }
    if (!block.cells.empty()) blocks.push_back(std::move(block));
  }
  return blocks;
}

void check_med_name(const std::string& name, std::size_t limit, std::string_view what) {
  // HDF5 keeps meshes and fields under their names as paths, and a trailing blank would be padding.
  if (name.empty() || name.find('/') != std::string::npos || name.find('\0') != std::string::npos ||
      name.ends_with(' ')) {
    throw Error("invalid-name", fmt::format("\"{}\" cannot be the name of a {} in a MED file", name, what));
  }
  if (name.size() <= limit) return;
  throw Error("name-too-long",
              fmt::format("the {} name {} has {} characters, and MED allows {}", what, name, name.size(), limit));
}

void check_written(med_err result, const MedFile& file, std::string_view what) {
  if (result < 0)
    throw Error("unwritable-file", fmt::format("{}: the MED library could not write {}", file.path(), what));
}

void check_writable(const Mesh& mesh, const std::string& name) {
  check_med_name(name, MED_NAME_SIZE, "mesh");
  if (mesh.nodes.empty()) throw Error("unwritable-mesh", fmt::format("mesh {} has no nodes", name));
  for (const auto& [group, members] : mesh.node_groups) check_med_name(group, MED_LNAME_SIZE, "group");
  for (const auto& [group, members] : mesh.cell_groups) check_med_name(group, MED_LNAME_SIZE, "group");
  for (const std::string& node : mesh.node_names) check_med_name(node, MED_SNAME_SIZE, "node");
  for (const std::string& cell : mesh.cell_names) check_med_name(cell, MED_SNAME_SIZE, "cell");
}

void write_mesh(const MedFile& file, const Mesh& mesh, const std::string& name) {
  const Families node_families = partition(mesh.node_groups, mesh.node_count());
  const Families cell_families = partition(mesh.cell_groups, mesh.cell_count());
  create_mesh(file, mesh, name);
  write_nodes(file, mesh, name, node_families);
  if (!mesh.node_names.empty()) write_names(file, name, MED_NODE, MED_NO_GEOTYPE, mesh.node_names);
  for (const MedBlock& block : med_blocks(mesh)) write_block(file, mesh, name, block, cell_families);
  check_written(MEDfamilyCr(file.id(), name.c_str(), "FAMILLE_ZERO", 0, 0, MED_NO_GROUP), file, "the empty family");
  write_families(file, name, node_families, 1);
  write_families(file, name, cell_families, -1);
}

void write_med_mesh(const std::string& path, const Mesh& mesh, const std::string& name) {
  check_writable(mesh, name);
  write_mesh(MedFile::create(path), mesh, name);
}

}  // namespace comma::solver
