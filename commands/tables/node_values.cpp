#include "commands/tables/node_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands/fields/field_reading.hpp"
#include "commands/model/angles.hpp"
#include "commands/points.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/statistics.hpp"
#include "solver/fields/stresses/equivalent.hpp"
#include "solver/fields/stresses/traction.hpp"
#include "solver/mesh/axes.hpp"
#include "solver/mesh/groups.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

std::optional<Eigen::Vector3d> second_direction(const Keywords& action) {
  return action.has("VECT_Y") ? std::optional(vector_of(action, "VECT_Y")) : std::nullopt;
}

bool takes_traction(const Keywords& action) { return action.has("TRAC_NOR") || action.has("TRAC_DIR"); }

// Stresses give a vector, a vector its part along the direction.
solver::NodalField traction_of(const Keywords& action, const std::vector<int>& line, const NodeValues& values,
                               const std::vector<int>& node_of_row) {
  if (action.has("TRAC_NOR")) {
    const auto normals = solver::line_normals(values.mesh, line, second_direction(action));
    const auto normal = [&](int row) { return normals(node_of_row[static_cast<std::size_t>(row)]); };
    return solver::tractions(values.field, values.rows, normal, "TR_NOR");
  }
  const Eigen::Vector3d direction = vector_of(action, "DIRECTION");
  const auto everywhere = [&](int) { return direction; };
  if (values.field.component("DX") >= 0) return solver::part_along(values.field, values.rows, everywhere, "TRAC_DIR");
  return solver::tractions(values.field, values.rows, everywhere, "TR_DIR");
}

solver::NodalField wanted_field(const Keywords& action, const std::vector<int>& line, const NodeValues& values) {
  std::vector<int> node_of_row(values.field.values.size() / std::max<std::size_t>(values.field.components.size(), 1));
  for (std::size_t i = 0; i < values.rows.size(); ++i)
    node_of_row[static_cast<std::size_t>(values.rows[i])] = values.nodes[i];
  if (takes_traction(action)) return traction_of(action, line, values, node_of_row);
  const auto axes = frame_axes(action, values.mesh, line);
  const auto of_row = [&](int row) { return (*axes)(node_of_row[static_cast<std::size_t>(row)]); };
  const solver::NodalField turned = axes ? solver::in_axes(values.field, values.rows, of_row) : values.field;
  if (action.has("INVARIANT")) return solver::tensor_invariants(turned);
  if (action.has("ELEM_PRINCIPAUX")) return solver::principal_values(turned);
  return turned;
}

}  // namespace

std::vector<double> abscissas(const NodeValues& values) {
  std::vector<double> along;
  for (std::size_t i = 0; i < values.nodes.size(); ++i) {
    const double step =
        i > 0 ? solver::distance(values.mesh.nodes[values.nodes[i - 1]], values.mesh.nodes[values.nodes[i]]) : 0.0;
    along.push_back(i > 0 ? along.back() + step : 0.0);
  }
  return along;
}

std::optional<solver::NodeAxes> round_axes(const Keywords& action, const solver::Mesh& mesh) {
  const std::string& frame = action.text("REPERE");
  if (frame == "POLAIRE") return solver::polar_axes(mesh);
  if (frame == "CYLINDRIQUE")
    return solver::revolution_axes(mesh, vector_of(action, "ORIGINE"), vector_of(action, "AXE_Z"));
  return std::nullopt;
}

Eigen::Matrix3d axes_by_angles(const Keywords& action) {
  const Eigen::Vector3d angles = vector_of(action, "ANGL_NAUT") * degree;
  return solver::nautical_axes(angles[0], angles[1], angles[2]);
}

std::optional<solver::NodeAxes> frame_axes(const Keywords& action, const solver::Mesh& mesh,
                                           const std::vector<int>& nodes) {
  const std::string& frame = action.text("REPERE");
  if (frame == "GLOBAL") return std::nullopt;
  if (frame == "UTILISATEUR") {
    const Eigen::Matrix3d axes = axes_by_angles(action);
    return [axes](int) { return axes; };
  }
  if (frame == "LOCAL") return solver::line_axes(mesh, nodes, second_direction(action));
  return solver::with_axes_of_neighbours(mesh, nodes, *round_axes(action, mesh));
}

void check_frame(const std::string& command, const Keywords& action, const std::vector<int>& rows,
                 const solver::NodalField& field) {
  const std::string& frame = action.text("REPERE");
  if (takes_traction(action) && frame != "GLOBAL" && frame != "LOCAL")
    throw DiagnosticError("excluded-keyword", fmt::format("{}: tractions are given in the axes of the mesh", command),
                          action.span_of("REPERE"), "leave out REPERE");
  if (frame == "GLOBAL" || action.has("INVARIANT") || action.has("ELEM_PRINCIPAUX") || takes_traction(action)) return;
  const char* keyword = action.has("RESULTANTE") ? "RESULTANTE" : "NOM_CMP";
  for (const std::string& name : action.has(keyword) ? action.texts(keyword) : field.components) {
    const int column = field.component(name);
    if (column < 0 || !solver::has_own_axes(field, name)) continue;
    if (std::ranges::all_of(rows, [&](int row) { return std::isnan(field.at(row, column)); })) continue;
    throw DiagnosticError("unsupported",
                          fmt::format("{}: {} has axes of its own, which REPERE does not turn", command, name),
                          action.span_of("REPERE"), "leave out REPERE, or name other components (NOM_CMP)");
  }
}

void take_wanted_values(const std::string& command, const Keywords& action, const std::vector<int>& line,
                        NodeValues& values) {
  try {
    values.field = wanted_field(action, line, values);
  } catch (const solver::Error& error) {
    const char* field = action.has("CHAM_GD") ? "CHAM_GD" : "NOM_CHAM";
    const char* keyword = error.code() == "incompatible-field" ? field : "REPERE";
    throw DiagnosticError(error.code(), fmt::format("{}: {}", command, error.what()), action.span_of(keyword),
                          error.code() == "missing-direction" ? "give VECT_Y" : error.hint());
  }
}

std::vector<int> wanted_components(const Keywords& action, const solver::NodalField& field) {
  if (!takes_traction(action)) return chosen_components(action, field.components);
  std::vector<int> all;
  for (std::size_t c = 0; c < field.components.size(); ++c) all.push_back(static_cast<int>(c));
  return all;
}

void add_entries(Table& table, const Keywords& action, const NodeValues& values) {
  const auto components = wanted_components(action, values.field);
  const auto along = abscissas(values);
  for (std::size_t i = 0; i < values.nodes.size(); ++i) {
    Row row = values.head;
    const Row label = values.label(i);
    row.insert(row.begin() + 1, label.begin(), label.end());
    const solver::Point& at = values.mesh.nodes[values.nodes[i]];
    row.insert(row.end(), {{"ABSC_CURV", along[i]}, {"COOR_X", at[0]}, {"COOR_Y", at[1]}, {"COOR_Z", at[2]}});
    bool carried = false;
    for (const int component : components) {
      const double value = values.field.at(values.rows[i], component);
      carried |= !std::isnan(value);
      row.emplace_back(values.field.components[component], std::isnan(value) ? Cell() : Cell(value));
    }
    if (carried) table.add_row(row);
  }
}

Profile profile(const NodeValues& values, int component) {
  Profile result;
  const auto along = abscissas(values);
  for (std::size_t i = 0; i < values.rows.size(); ++i) {
    const double value = values.field.at(values.rows[i], component);
    if (std::isnan(value)) continue;
    result.abscissas.push_back(along[i]);
    result.values.push_back(value);
  }
  if (result.values.empty()) {
    throw DiagnosticError("unknown-component",
                          fmt::format("no node there carries {}", values.field.components[component]));
  }
  return result;
}

void add_line_means(Table& table, const Keywords& action, const NodeValues& values) {
  const auto components = wanted_components(action, values.field);
  std::vector<solver::LineMean> means;
  for (const int component : components) {
    const Profile along = profile(values, component);
    means.push_back(solver::line_mean(along.abscissas, along.values));
  }
  const auto add = [&](const char* quantity, auto&& value_of) {
    Row row = values.head;
    row.emplace_back("QUANTITE", quantity);
    for (std::size_t i = 0; i < components.size(); ++i)
      row.emplace_back(values.field.components[components[i]], value_of(means[i]));
    table.add_row(row);
  };
  add("MOMENT_0", [](const auto& mean) { return mean.mean; });
  add("MOMENT_1", [](const auto& mean) { return mean.slope; });
  add("MINIMUM", [](const auto& mean) { return mean.least; });
  add("MAXIMUM", [](const auto& mean) { return mean.greatest; });
  add("MOYE_INT", [](const auto& mean) { return mean.first(); });
  add("MOYE_EXT", [](const auto& mean) { return mean.last(); });
}

}  // namespace comma::commands
