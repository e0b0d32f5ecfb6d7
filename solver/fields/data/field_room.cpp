#include "solver/fields/data/field_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "solver/elements/discrete/discrete_forces.hpp"
#include "solver/elements/quadrature.hpp"
#include "solver/elements/slender/beam_points.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

namespace {

/// The stresses or strains of an element that carries stiffness; nothing for other quantities.
std::set<std::string_view> known_components(const ElementField& field, Formulation formulation, CellType type) {
  static const std::set<std::string_view> plane_strains = {"EPXX", "EPYY", "EPZZ", "EPXY"},
                                          solid_strains = {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"};
  const int continuum = continuum_dimension(formulation);
  if (field.support == Support::cell) return {};
  if (field.quantity == "EPSI_R")
    return continuum == 3 ? solid_strains : continuum == 2 ? plane_strains : std::set<std::string_view>();
  if (field.quantity != "SIEF_R") return {};
  std::set<std::string_view> names;
  const auto add = [&](auto&& others) { names.insert(others.begin(), others.end()); };
  if (continuum == 2) add(plane_stress_names);
  if (continuum == 3) add(solid_stress_names);
  if (mixed_field_count(formulation) > 0) add(std::array{std::string_view("SIP")});
  if (is_stabilised(formulation, type) && field.support == Support::gauss_point) add(hourglass_stress_names);
  if (is_beam(formulation)) add(beam_force_names);
  if (is_bar(formulation)) add(std::array{beam_force_names[0]});
  if (is_discrete(formulation)) add(discrete_force_names(formulation));
  return names;
}

int point_count(const Model& model, int cell, Support support, bool skin) {
  const Formulation formulation = model.formulations[cell];
  const bool is_skin = model.is_skin(cell);
  if (formulation == Formulation::none || (is_skin && !skin)) return 0;
  const CellType type = model.mesh->cell_types[cell];
  if (support == Support::cell) return 1;
  if (support == Support::element_node) return node_count(type);
  if (is_skin) return static_cast<int>(quadrature(type, boundary_family(type)).size());
  if (continuum_dimension(formulation) > 0) {
    return static_cast<int>(quadrature(type, stiffness_family(type, formulation)).size());
  }
  if (is_plate(formulation)) return static_cast<int>(quadrature(type, plate_family(type)).size());
  if (is_discrete(formulation)) return node_count(type);  // of springs at both ends
  return is_beam(formulation) ? beam_point_count : 1;
}

}  // namespace

ElementField empty_element_field(const Model& model, std::string quantity, Support support,
                                 std::vector<std::string> components, bool skin) {
  ElementField field{std::move(quantity), support, std::move(components), {0}, {}};
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    field.starts.push_back(field.starts.back() + point_count(model, cell, support, skin));
  }
  field.values.assign(static_cast<std::size_t>(field.starts.back()) * field.components.size(), absent);
  return field;
}

ElementField empty_cell_field(const Mesh& mesh, std::string quantity, std::vector<std::string> components) {
  ElementField field{std::move(quantity), Support::cell, std::move(components), {}, {}};
  field.starts.resize(mesh.cell_types.size() + 1);
  std::iota(field.starts.begin(), field.starts.end(), 0);
  field.values.assign(mesh.cell_types.size() * field.components.size(), absent);
  return field;
}

NodalField empty_nodal_field(const Mesh& mesh, std::string quantity, std::vector<std::string> components) {
  std::vector<double> values(mesh.nodes.size() * components.size(), absent);
  return {std::move(quantity), std::move(components), std::move(values)};
}

NodalField node_coordinates(const Mesh& mesh) {
  NodalField field = empty_nodal_field(mesh, "GEOM_R", {"X", "Y", "Z"});
  auto target = field.values.begin();
  for (const Point& at : mesh.nodes) target = std::copy(at.begin(), at.end(), target);
  return field;
}

Field uniform_like(const Field& other, std::string component, double value) {
  Field field = other;
  values_of(field).assign(static_cast<std::size_t>(FieldRows(other).total()), value);
  components_of(field) = {std::move(component)};
  return field;
}

void fill_absent(Field& field, double value) {
  for (double& each : values_of(field)) {
    if (std::isnan(each)) each = value;
  }
}

void fill_with_zeros(ElementField& field, const Model& model) {
  std::map<std::pair<Formulation, CellType>, std::set<std::string_view>> known;
  std::set<std::string_view> wanted;
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    if (field.points(cell) == 0 || model.is_skin(cell)) continue;
    const std::pair kind(model.formulations[static_cast<std::size_t>(cell)],
                         model.mesh->cell_types[static_cast<std::size_t>(cell)]);
    if (known.contains(kind)) continue;
    known[kind] = known_components(field, kind.first, kind.second);
    wanted.insert(known[kind].begin(), known[kind].end());
  }
  const std::size_t before = field.components.size();
  for (const std::string_view name : wanted)
    if (field.component(name) < 0) field.components.emplace_back(name);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(field.starts.back()) * field.components.size());
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    const auto kind = known.find(
        {model.formulations[static_cast<std::size_t>(cell)], model.mesh->cell_types[static_cast<std::size_t>(cell)]});
    std::vector<double> unsaid;
    for (const std::string& name : field.components) {
      const bool is_own = kind == known.end() || kind->second.empty() || kind->second.contains(name);
      unsaid.push_back(is_own || !wanted.contains(name) ? 0.0 : absent);
    }
    for (int row = field.starts[static_cast<std::size_t>(cell)]; row < field.starts[static_cast<std::size_t>(cell) + 1];
         ++row)
      for (std::size_t c = 0; c < unsaid.size(); ++c) {
        const double said = c < before ? field.values[static_cast<std::size_t>(row) * before + c] : absent;
        values.push_back(std::isnan(said) ? unsaid[c] : said);
      }
  }
  field.values = std::move(values);
}

void drop_empty_cells(ElementField& field) {
  const auto cell_count = static_cast<int>(field.starts.size()) - 1;
  const auto width = static_cast<std::ptrdiff_t>(field.components.size());
  std::vector<int> starts = {0};
  std::vector<double> values;
  for (int cell = 0; cell < cell_count; ++cell) {
    const auto begin = field.values.begin() + field.starts[cell] * width;
    const auto end = field.values.begin() + field.starts[cell + 1] * width;
    const bool carries = std::any_of(begin, end, [](double value) { return !std::isnan(value); });
    if (carries) values.insert(values.end(), begin, end);
    starts.push_back(starts.back() + (carries ? field.points(cell) : 0));
  }
  field.starts = std::move(starts);
  field.values = std::move(values);
}

}  // namespace comma::solver
