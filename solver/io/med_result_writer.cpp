// Writing results as MED fields. A field's values are written type by type; where only some of the nodes or cells carry
// it, a profile lists them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "solver/error.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/io/med_file.hpp"
#include "solver/io/med_localization.hpp"
#include "solver/io/med_mesh_writer.hpp"
#include "solver/mesh/reference_cell.hpp"

namespace comma::solver {
namespace {

/// Where the values of one call to the MED library sit.
struct Place {
  med_entity_type entity = MED_NODE;
  med_geometry_type geometry = MED_NO_GEOTYPE;
  std::string profile;
  std::string localization;
  med_int entities = 0;  ///< of that type in the whole mesh
};

class MedResultWriter {
 public:
  MedResultWriter(const MedFile& file, const Mesh& mesh, const std::string& mesh_name)
      : file_(file), mesh_(mesh), mesh_name_(mesh_name), blocks_(med_blocks(mesh)) {}

  void write(const std::string& name, const ResultStep& step, const Field& field);
  /// Takes note of what the file holds.
  void go_on();

 private:
  void create(const std::string& name, const std::vector<std::string>& components);
  void write_nodal(const std::string& name, const ResultStep& step, const NodalField& field);
  void write_block(const std::string& name, const ResultStep& step, const ElementField& field, const MedBlock& block);
  void write_values(const std::string& name, const ResultStep& step, const Place& place,
                    const std::vector<double>& values) const;
  std::string profile(const std::vector<med_int>& chosen, std::size_t all);
  std::string localization(CellType type, int points);

  const MedFile& file_;
  const Mesh& mesh_;
  const std::string& mesh_name_;
  std::vector<MedBlock> blocks_;
  std::map<std::string, std::vector<std::string>> components_;  ///< of the fields created so far
  std::set<std::string> foreign_;                               ///< fields of other meshes
  std::map<std::vector<med_int>, std::string> profiles_;
  med_int first_profile_ = 1;
  std::set<std::string> localizations_;
};

/// MED has no word for a component that some of the nodes lack: it is written as 0, as Code_Aster does.
double written_value(double value) { return std::isnan(value) ? 0.0 : value; }

bool carries_any(std::span<const double> values) {
  return std::ranges::any_of(values, [](double value) { return !std::isnan(value); });
}

void MedResultWriter::go_on() {
  std::string name(MED_NAME_SIZE + 1, '\0'), mesh_name = name, interpolation = name, section = name;
  const med_int fields = MEDnField(file_.id());
  for (int k = 1; k <= fields; ++k) {
    const med_int count = MEDfieldnComponent(file_.id(), k);
    std::string components(static_cast<std::size_t>(count) * MED_SNAME_SIZE + 1, '\0'), units = components;
    std::array<char, MED_SNAME_SIZE + 1> unit_of_time{};
    med_bool local = MED_FALSE;
    med_field_type type{};
    med_int steps = 0;
    check_written(MEDfieldInfo(file_.id(), k, name.data(), mesh_name.data(), &local, &type, components.data(),
                               units.data(), unit_of_time.data(), &steps),
                  file_, "its fields, which cannot be read");
    if (trimmed(mesh_name) != mesh_name_) foreign_.insert(trimmed(name));
    auto& own = components_[trimmed(name)];
    for (med_int c = 0; c < count; ++c)
      own.push_back(
          trimmed(std::string_view(components).substr(static_cast<std::size_t>(c) * MED_SNAME_SIZE, MED_SNAME_SIZE)));
  }
  first_profile_ = MEDnProfile(file_.id()) + 1;
  const med_int schemes = MEDnLocalization(file_.id());
  for (int k = 1; k <= schemes; ++k) {
    med_geometry_type geometry{}, section_type{};
    med_int dimension = 0, points = 0, section_cells = 0;
    check_written(MEDlocalizationInfo(file_.id(), k, name.data(), &geometry, &dimension, &points, interpolation.data(),
                                      section.data(), &section_cells, &section_type),
                  file_, "its Gauss points, which cannot be read");
    localizations_.insert(trimmed(name));
  }
}

void MedResultWriter::create(const std::string& name, const std::vector<std::string>& components) {
  if (foreign_.contains(name))
    throw Error("unsupported", fmt::format("the file holds a field {} on another mesh", name),
                "write it to another UNITE");
  const auto [entry, is_new] = components_.try_emplace(name, components);
  if (!is_new) {
    if (entry->second == components) return;
    throw Error("unsupported", fmt::format("field {} does not have the same components in all steps", name));
  }
  check_med_name(name, MED_NAME_SIZE, "field");
  for (const std::string& component : components) check_med_name(component, MED_SNAME_SIZE, "component");
  const std::vector<std::string> units(components.size());
  check_written(MEDfieldCr(file_.id(), name.c_str(), MED_FLOAT64, static_cast<med_int>(components.size()),
                           padded(components, MED_SNAME_SIZE).c_str(), padded(units, MED_SNAME_SIZE).c_str(), "",
                           mesh_name_.c_str()),
                file_, fmt::format("field {}", name));
}

void MedResultWriter::write_values(const std::string& name, const ResultStep& step, const Place& place,
                                   const std::vector<double>& values) const {
  check_written(MEDfieldValueWithProfileWr(file_.id(), name.c_str(), step.order, MED_NO_IT, step.instant, place.entity,
                                           place.geometry, MED_COMPACT_STMODE, place.profile.c_str(),
                                           place.localization.c_str(), MED_FULL_INTERLACE, MED_ALL_CONSTITUENT,
                                           place.entities, reinterpret_cast<const unsigned char*>(values.data())),
                file_, fmt::format("the values of field {}", name));
}

/// The name of the profile of the chosen entities (numbered from 1); MED_NO_PROFILE when they are all there are.
std::string MedResultWriter::profile(const std::vector<med_int>& chosen, std::size_t all) {
  if (chosen.size() == all) return MED_NO_PROFILE;
  const auto [entry, is_new] = profiles_.try_emplace(
      chosen, fmt::format("PROFILE_{}", static_cast<std::size_t>(first_profile_) + profiles_.size()));
  if (is_new) {
    check_written(MEDprofileWr(file_.id(), entry->second.c_str(), static_cast<med_int>(chosen.size()), chosen.data()),
                  file_, "a profile");
  }
  return entry->second;
}

std::string MedResultWriter::localization(CellType type, int points) {
  const std::string name = fmt::format("{}_{}_POINTS", name_of(type), points);
  if (!localizations_.insert(name).second) return name;
  const auto scheme = gauss_scheme(type, points);
  if (!scheme) {
    throw Error("unsupported",
                fmt::format("a field with {} Gauss points on {} cells cannot be written to a MED file yet", points,
                            name_of(type)));
  }
  const auto flatten = [&](const std::vector<Point>& from) {
    std::vector<med_float> flat;
    for (const Point& point : from)
      flat.insert(flat.end(), point.begin(), point.begin() + std::max(dimension(type), 1));
    return flat;
  };
  auto nodes = reference_points(type);
  const auto ours = nodes;
  const auto order = med_node_order(type);
  for (std::size_t i = 0; i < order.size(); ++i) nodes[static_cast<std::size_t>(order[i])] = ours[i];
  check_written(MEDlocalizationWr(file_.id(), name.c_str(), med_geometry(type), std::max(dimension(type), 1),
                                  flatten(nodes).data(), MED_FULL_INTERLACE, points, flatten(scheme->points).data(),
                                  scheme->weights.data(), MED_NO_INTERPOLATION, MED_NO_MESH_SUPPORT),
                file_, "a localisation of Gauss points");
  return name;
}

void MedResultWriter::write_nodal(const std::string& name, const ResultStep& step, const NodalField& field) {
  const std::size_t width = field.components.size();
  std::vector<med_int> carriers;
  std::vector<double> values;
  for (int node = 0; node < mesh_.node_count(); ++node) {
    const auto own = std::span(field.values).subspan(static_cast<std::size_t>(node) * width, width);
    if (!carries_any(own)) continue;
    carriers.push_back(node + 1);
    std::ranges::transform(own, std::back_inserter(values), written_value);
  }
  if (carriers.empty()) return;
  Place place;
  place.profile = profile(carriers, mesh_.nodes.size());
  place.entities = mesh_.node_count();
  write_values(name, step, place, values);
}

void MedResultWriter::write_block(const std::string& name, const ResultStep& step, const ElementField& field,
                                  const MedBlock& block) {
  const std::size_t width = field.components.size();
  const auto order =
      field.support == Support::element_node ? med_node_order(block.type) : std::span<const std::int8_t>{};
  struct Part {
    std::vector<med_int> cells;
    std::vector<double> values;
  };
  std::map<int, Part> parts;  // by number of points: cells of one type may have different elements
  for (std::size_t i = 0; i < block.cells.size(); ++i) {
    const int cell = block.cells[i];
    const int points = field.points(cell);
    if (points == 0) continue;
    if (field.support == Support::element_node && points != node_count(block.type)) {
      throw Error("unsupported", fmt::format("field {}: {} has values at {} of its {} nodes", name,
                                             mesh_.cell_name(cell), points, node_count(block.type)));
    }
    Part& part = parts[points];
    part.cells.push_back(static_cast<med_int>(i) + 1);
    const std::size_t start = part.values.size();
    part.values.resize(start + static_cast<std::size_t>(points) * width);
    for (int point = 0; point < points; ++point) {
      const auto place = static_cast<std::size_t>(order.empty() ? point : order[static_cast<std::size_t>(point)]);
      for (std::size_t j = 0; j < width; ++j) {
        part.values[start + place * width + j] = written_value(field.at(cell, point, static_cast<int>(j)));
      }
    }
  }
  for (const auto& [points, part] : parts) {
    Place place;
    place.entity = field.support == Support::element_node ? MED_NODE_ELEMENT : MED_CELL;
    place.geometry = med_geometry(block.type);
    place.profile = profile(part.cells, block.cells.size());
    if (field.support == Support::gauss_point) place.localization = localization(block.type, points);
    place.entities = static_cast<med_int>(block.cells.size());
    write_values(name, step, place, part.values);
  }
}

void MedResultWriter::write(const std::string& name, const ResultStep& step, const Field& field) {
  create(name, components_of(field));
  if (const auto* nodal = std::get_if<NodalField>(&field)) return write_nodal(name, step, *nodal);
  for (const MedBlock& block : blocks_) write_block(name, step, std::get<ElementField>(field), block);
}

/// The result's name filled up to eight characters with underscores, then the field's (U7.05.21).
std::string field_name(const std::string& result, std::string_view field) {
  std::string name = result;
  if (field.empty()) return name;
  if (name.size() < 8) name.append(8 - name.size(), '_');
  return name.append(field);
}

/// The field with these components, those that it has not being absent.
Field with_names(const Field& field, const std::vector<std::string>& names) {
  Field result = field;
  std::visit(
      [&](auto& made) {
        const auto& given = std::get<std::decay_t<decltype(made)>>(field);
        const std::size_t width = given.components.size(), rows = width == 0 ? 0 : given.values.size() / width;
        made.components = names;
        made.values.assign(rows * names.size(), absent);
        for (std::size_t c = 0; c < names.size(); ++c) {
          const int column = given.component(names[c]);
          for (std::size_t row = 0; row < rows && column >= 0; ++row)
            made.values[row * names.size() + c] = given.values[row * width + static_cast<std::size_t>(column)];
        }
      },
      result);
  return result;
}

/// A field of the file has the components that any of its steps has: laws that change have other internal variables.
void write_all(MedResultWriter& writer, std::span<const NamedResult> results) {
  std::map<std::string, std::vector<std::string>> components;
  const auto each_field = [&](auto&& visit) {
    for (const NamedResult& each : results)
      for (const ResultStep& step : each.result.steps)
        for (const auto& [name, field] : step.fields) visit(field_name(each.name, name), step, field);
  };
  each_field([&](const std::string& name, const ResultStep&, const Field& field) {
    std::vector<std::string>& all = components[name];
    for (const std::string& component : components_of(field))
      if (std::ranges::find(all, component) == all.end()) all.push_back(component);
  });
  each_field([&](const std::string& name, const ResultStep& step, const Field& field) {
    const std::vector<std::string>& all = components.at(name);
    writer.write(name, step, all == components_of(field) ? field : with_names(field, all));
  });
}

}  // namespace

void write_med_results(const std::string& path, const Mesh& mesh, const std::string& mesh_name,
                       std::span<const NamedResult> results) {
  check_writable(mesh, mesh_name);
  const MedFile file = MedFile::create(path);
  write_mesh(file, mesh, mesh_name);
  MedResultWriter writer(file, mesh, mesh_name);
  write_all(writer, results);
}

void add_med_results(const std::string& path, const Mesh& mesh, const std::string& mesh_name, bool has_mesh,
                     std::span<const NamedResult> results) {
  check_writable(mesh, mesh_name);
  const MedFile file = MedFile::open_for_adding(path);
  if (!has_mesh) write_mesh(file, mesh, mesh_name);
  MedResultWriter writer(file, mesh, mesh_name);
  writer.go_on();
  write_all(writer, results);
}

void write_med_result(const std::string& path, const Mesh& mesh, const std::string& mesh_name, const Result& result,
                      const std::string& result_name) {
  write_med_results(path, mesh, mesh_name, std::vector<NamedResult>{{result, result_name}});
}

}  // namespace comma::solver
