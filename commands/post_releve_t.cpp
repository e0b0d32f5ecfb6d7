#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "commands/commands.hpp"
#include "commands/fields/field_reading.hpp"
#include "commands/model/angles.hpp"
#include "commands/points.hpp"
#include "commands/selection.hpp"
#include "commands/tables/extreme_rows.hpp"
#include "commands/tables/reductions.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/fields/equivalent.hpp"
#include "solver/fields/rotation.hpp"
#include "solver/fields/statistics.hpp"
#include "solver/mesh/axes.hpp"
#include "solver/mesh/groups.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
// The nodes of an action, and its values there in its frame.
struct Reading {
  Row head;  ///< the columns that say where the values come from
  const solver::Mesh& mesh;
  std::vector<int> nodes;
  solver::NodalField field;
};

std::vector<double> abscissas(const Reading& reading) {
  std::vector<double> values;
  for (std::size_t i = 0; i < reading.nodes.size(); ++i) {
    const double step =
        i > 0 ? solver::distance(reading.mesh.nodes[reading.nodes[i - 1]], reading.mesh.nodes[reading.nodes[i]]) : 0.0;
    values.push_back(i > 0 ? values.back() + step : 0.0);
  }
  return values;
}

Eigen::Vector3d vector_of(const Keywords& action, const char* keyword) {
  return Eigen::Vector3d(point_of(action, keyword).data());
}

Eigen::Matrix3d axes_by_angles(const Keywords& action) {
  const Eigen::Vector3d angles = vector_of(action, "ANGL_NAUT") * degree;
  return solver::nautical_axes(angles[0], angles[1], angles[2]);
}

// Components that keep their direction have nothing to do in another frame.
void check_frame(const Keywords& action, const std::vector<int>& nodes, const solver::NodalField& field) {
  if (action.text("REPERE") == "GLOBAL" || action.has("INVARIANT") || action.has("ELEM_PRINCIPAUX")) return;
  const char* keyword = action.has("RESULTANTE") ? "RESULTANTE" : "NOM_CMP";
  for (const std::string& name : action.has(keyword) ? action.texts(keyword) : field.components) {
    const int column = field.component(name);
    if (column < 0 || !solver::has_own_axes(field, name)) continue;
    if (std::ranges::all_of(nodes, [&](int node) { return std::isnan(field.at(node, column)); })) continue;
    throw DiagnosticError("unsupported",
                          fmt::format("POST_RELEVE_T: {} has axes of its own, which REPERE does not turn", name),
                          action.span_of("REPERE"), "leave out REPERE, or name other components (NOM_CMP)");
  }
}

// Axes that go round a line; nothing for other frames.
std::optional<solver::NodeAxes> round_axes(const Keywords& action, const solver::Mesh& mesh) {
  const std::string& frame = action.text("REPERE");
  if (frame == "POLAIRE") return solver::polar_axes(mesh);
  if (frame == "CYLINDRIQUE")
    return solver::revolution_axes(mesh, vector_of(action, "ORIGINE"), vector_of(action, "AXE_Z"));
  return std::nullopt;
}

solver::NodalField in_frame(const Keywords& action, const solver::Mesh& mesh, const std::vector<int>& nodes,
                            const solver::NodalField& field) {
  const std::string& frame = action.text("REPERE");
  if (frame == "GLOBAL") return field;
  if (frame == "UTILISATEUR") {
    const Eigen::Matrix3d axes = axes_by_angles(action);
    return solver::in_axes(field, nodes, [&](int) { return axes; });
  }
  if (frame == "LOCAL") {
    const auto second = action.has("VECT_Y") ? std::optional(vector_of(action, "VECT_Y")) : std::nullopt;
    return solver::in_axes(field, nodes, solver::line_axes(mesh, nodes, second));
  }
  return solver::in_axes(field, nodes, solver::with_axes_of_neighbours(mesh, nodes, *round_axes(action, mesh)));
}

// The values themselves, or what is made of the tensors.
solver::NodalField wanted_quantities(const Keywords& action, solver::NodalField field) {
  if (action.has("INVARIANT")) return solver::tensor_invariants(field);
  if (action.has("ELEM_PRINCIPAUX")) return solver::principal_values(field);
  return field;
}

solver::NodalField values_in_frame(const Keywords& action, const solver::Mesh& mesh, const std::vector<int>& nodes,
                                   const solver::NodalField& field) {
  try {
    return wanted_quantities(action, in_frame(action, mesh, nodes, field));
  } catch (const solver::Error& error) {
    const char* keyword =
        error.code() == "incompatible-field" ? (action.has("RESULTAT") ? "NOM_CHAM" : "CHAM_GD") : "REPERE";
    throw DiagnosticError(error.code(), std::string("POST_RELEVE_T: ") + error.what(), action.span_of(keyword),
                          error.code() == "missing-direction" ? "give VECT_Y" : error.hint());
  }
}

struct Place {
  std::vector<int> nodes, cells;
};

void require_place(const Keywords& action) {
  if (names_a_place(action)) return;
  throw DiagnosticError("missing-one-of", "POST_RELEVE_T: ACTION names no place", action.span,
                        "give GROUP_NO, NOEUD, GROUP_MA, MAILLE or TOUT");
}

// Named nodes in the order of the file; cells beside them are those whose values count at a node. Cells alone give
// their nodes.
Place place_of(const Keywords& action, const solver::Mesh& mesh) {
  const bool by_nodes = names_a_place(action, node_places);
  auto nodes = selected_nodes(action, mesh, by_nodes ? node_places : PlaceKeywords());
  require_place(action);
  return {std::move(nodes), selected_cells(action, mesh, cell_places)};
}

Row head_of_action(const Keywords& action, const FieldSource& source) {
  Row head = {{"INTITULE", action.has("INTITULE") ? action.text("INTITULE") : ""}};
  head.insert(head.end(), source.columns.begin(), source.columns.end());
  return head;
}

// What comes of the order of the nodes: REPERE='LOCAL' tangents, OPERATION='MOYENNE' means along a line, and
// 'EXTRACTION' places along one, where the nodes lie on it. Nothing: the order does not matter.
std::string use_of_order(const Keywords& action, const Reading& reading) {
  if (action.has("RESULTANTE")) return {};
  if (action.text("REPERE") == "LOCAL") return "REPERE='LOCAL'";
  const auto operations = action.texts("OPERATION");
  const auto does = [&](const char* word) { return std::ranges::find(operations, word) != operations.end(); };
  if (does("MOYENNE")) return "OPERATION='MOYENNE'";
  return does("EXTRACTION") && solver::lie_on_a_line(reading.mesh, reading.nodes) ? "ABSC_CURV" : "";
}

void warn_of_order(const Keywords& action, const Reading& reading, Context& context) {
  const std::string use = use_of_order(action, reading);
  if (use.empty()) return;
  const auto node = solver::node_out_of_order(reading.mesh, reading.nodes);
  if (!node) return;
  context.diagnostics.alarm(
      "nodes-out-of-order",
      fmt::format("POST_RELEVE_T: the nodes do not follow each other along a line, as {} takes them to: the way turns "
                  "back at {}",
                  use, reading.mesh.node_name(*node)),
      action.span_of(use.starts_with("REPERE") ? "REPERE" : "OPERATION"),
      "make an ordered group by DEFI_GROUP(CREA_GROUP_NO=_F(OPTION='NOEUD_ORDO', ...))");
}

// Away from an axis there is no direction on it: nodes there take the axes of others.
void warn_of_axis(const Keywords& action, const Reading& reading, Context& context) {
  const auto axes = round_axes(action, reading.mesh);
  if (!axes || action.has("RESULTANTE")) return;
  const auto on_axis = std::ranges::find_if(reading.nodes, [&](int node) { return !solver::has_axes(*axes, node); });
  if (on_axis == reading.nodes.end()) return;
  context.diagnostics.alarm("node-on-axis",
                            fmt::format("POST_RELEVE_T: node {} lies on the axis, where there is no radial direction: "
                                        "it takes the axes of the nearest node off it",
                                        reading.mesh.node_name(*on_axis)),
                            action.span_of("REPERE"), "leave it out, or look at its values in the axes of the mesh");
}

Reading read(const Keywords& action, const FieldSource& source) {
  auto [nodes, cells] = place_of(action, source.mesh);
  solver::NodalField field = at_nodes(action, source, cells.empty() ? nullptr : &cells);
  check_frame(action, nodes, field);
  Row head = head_of_action(action, source);
  // A resultant is turned as a whole.
  if (!action.has("RESULTANTE")) field = values_in_frame(action, source.mesh, nodes, field);
  return {std::move(head), source.mesh, std::move(nodes), std::move(field)};
}

std::vector<int> wanted_components(const Keywords& action, const solver::NodalField& field) {
  return chosen_components(action, field.components);
}

// The place, the curvilinear abscissa along the list of nodes and the values (U4.81.21) where any of the components is
// carried.
template <class ValueOf>
void add_values(Table& table, const Reading& reading, std::size_t i, double along, Row row,
                const std::vector<std::string>& names, const std::vector<int>& components, ValueOf&& value_of) {
  const solver::Point& at = reading.mesh.nodes[reading.nodes[i]];
  row.insert(row.begin() + 1, {"NOEUD", table_node(reading.mesh, reading.nodes[i])});
  row.insert(row.end(), {{"ABSC_CURV", along}, {"COOR_X", at[0]}, {"COOR_Y", at[1]}, {"COOR_Z", at[2]}});
  bool carried = false;
  for (const int component : components) {
    const double value = value_of(component);
    carried |= !std::isnan(value);
    row.emplace_back(names[component], std::isnan(value) ? Cell() : Cell(value));
  }
  if (carried) table.add_row(row);
}

// One row a node.
void extract(Table& table, const Keywords& action, const Reading& reading) {
  const auto components = wanted_components(action, reading.field);
  const auto along = abscissas(reading);
  for (std::size_t i = 0; i < reading.nodes.size(); ++i) {
    add_values(table, reading, i, along[i], reading.head, reading.field.components, components,
               [&](int component) { return reading.field.at(reading.nodes[i], component); });
  }
}

// What a node has from the cells around it is wanted as it is.
const solver::ElementField& field_by_cells(const Keywords& action, const FieldSource& source) {
  const auto* field = std::get_if<solver::ElementField>(&source.field);
  if (field == nullptr || field->support != solver::Support::element_node) {
    throw DiagnosticError("unsupported",
                          "POST_RELEVE_T: MOYE_NOEUD='NON' is for fields at the nodes of cells (..._ELNO)",
                          action.span_of("MOYE_NOEUD"), "leave out MOYE_NOEUD");
  }
  const bool plain = action.text("REPERE") == "GLOBAL" && !action.has("INVARIANT") && !action.has("ELEM_PRINCIPAUX") &&
                     !action.has("RESULTANTE");
  const auto operations = action.texts("OPERATION");
  if (!plain || operations.size() != 1 || operations.front() != "EXTRACTION") {
    throw DiagnosticError(
        "unsupported",
        "POST_RELEVE_T: with MOYE_NOEUD='NON' comma extracts components in the axes of the mesh, and nothing else",
        action.span_of("MOYE_NOEUD"), "take the averages at nodes");
  }
  return *field;
}

// For each node the cells around it that count (all without `cells`), and its number in each.
using Corners = std::vector<std::pair<int, int>>;
std::vector<Corners> corners_at(const solver::Mesh& mesh, const solver::ElementField& field,
                                const std::vector<int>& cells, const std::vector<int>& nodes) {
  std::vector<int> place(mesh.nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) place[static_cast<std::size_t>(nodes[i])] = static_cast<int>(i);
  std::vector<Corners> around(nodes.size());
  const auto add = [&](int cell) {
    if (field.points(cell) == 0) return;
    const auto own = mesh.cell(cell);
    for (std::size_t a = 0; a < own.size(); ++a)
      if (const int i = place[static_cast<std::size_t>(own[a])]; i >= 0)
        around[static_cast<std::size_t>(i)].emplace_back(cell, static_cast<int>(a));
  };
  if (cells.empty()) {
    for (int cell = 0; cell < mesh.cell_count(); ++cell) add(cell);
  } else {
    std::ranges::for_each(cells, add);
  }
  return around;
}

// One row a node and cell around it.
void extract_by_cells(Table& table, const Keywords& action, const FieldSource& source) {
  const solver::ElementField& field = field_by_cells(action, source);
  auto [nodes, cells] = place_of(action, source.mesh);
  const Reading reading{head_of_action(action, source), source.mesh, std::move(nodes), {}};
  const auto components = chosen_components(action, field.components);
  const auto along = abscissas(reading);
  const auto around = corners_at(source.mesh, field, cells, reading.nodes);
  for (std::size_t i = 0; i < reading.nodes.size(); ++i) {
    for (const auto& [cell, corner] : around[i]) {
      Row row = reading.head;
      row.insert(row.begin() + 1, {"MAILLE", table_cell(source.mesh, cell)});
      add_values(table, reading, i, along[i], std::move(row), field.components, components,
                 [&](int component) { return field.at(cell, corner, component); });
    }
  }
}

// The vector of forces that components belong to: DX, DY, DZ, or what else ends so (RX, RNX, FX ...).
std::array<std::string, 3> force_components(const Keywords& action, const solver::NodalField& field) {
  std::string stem;
  for (const std::string& name : action.texts("RESULTANTE")) {
    component_of(action, field.components, name, "RESULTANTE");
    const std::string own = name.substr(0, name.size() - 1);
    const bool is_axis = name.size() > 1 && name.find_last_of("XYZ") == name.size() - 1 && !own.ends_with('X') &&
                         !own.ends_with('Y') && !own.ends_with('Z');
    if (!is_axis || (!stem.empty() && own != stem))
      throw DiagnosticError(
          "wrong-component",
          fmt::format("POST_RELEVE_T: a moment is that of one vector of forces, and {} is no component of {}", name,
                      stem.empty() ? "one" : stem + "X, " + stem + "Y, " + stem + "Z"),
          action.span_of("RESULTANTE"),
          "name components such as DX, DY, DZ of FORC_NODA or RX, RY, RZ of CONT_NOEU, or leave out MOMENT and POINT");
    stem = own;
  }
  return {stem + "X", stem + "Y", stem + "Z"};
}

// The sum over the nodes; with MOMENT under the names of a torsor's parts.
void sum(Table& table, const Keywords& action, const Reading& reading) {
  if (const std::string& frame = action.text("REPERE"); frame != "GLOBAL" && frame != "UTILISATEUR") {
    throw DiagnosticError("unsupported", "POST_RELEVE_T: a resultant has no axes that change from node to node",
                          action.span_of("REPERE"), "take it in REPERE='GLOBAL' or 'UTILISATEUR'");
  }
  const Eigen::Matrix3d axes =
      action.text("REPERE") == "UTILISATEUR" ? axes_by_angles(action) : Eigen::Matrix3d::Identity();
  Row row = reading.head;
  if (action.has("MOMENT")) {
    const solver::Resultant total =
        solver::resultant(reading.mesh, reading.field, reading.nodes, vector_of(action, "POINT"),
                          force_components(action, reading.field));
    const Eigen::Vector3d force = axes * total.force, moment = axes * total.moment;
    for (int i = 0; i < 3; ++i) row.emplace_back(fmt::format("RESULT_{}", "XYZ"[i]), force[i]);
    for (int i = 0; i < 3; ++i) row.emplace_back(fmt::format("MOMENT_{}", "XYZ"[i]), moment[i]);
    table.add_row(row);
    return;
  }
  const bool turned = action.text("REPERE") == "UTILISATEUR";
  const auto& field = turned ? solver::in_axes(reading.field, reading.nodes, [&](int) { return axes; }) : reading.field;
  for (const std::string& name : action.texts("RESULTANTE")) {
    const int component = component_of(action, field.components, name, "RESULTANTE");
    double total = 0.0;
    bool any = false;
    for (const int node : reading.nodes) {
      const double value = field.at(node, component);
      if (std::isnan(value)) continue;
      total += value;
      any = true;
    }
    if (!any)
      throw DiagnosticError("unknown-component",
                            fmt::format("POST_RELEVE_T: no node there carries {}, so it has no resultant", name),
                            action.span_of("RESULTANTE"));
    row.emplace_back(name, total);
  }
  table.add_row(row);
}

// The values of a component at the nodes that carry it, and their abscissas.
struct Profile {
  std::vector<double> abscissas, values;
  std::vector<int> nodes;
};

Profile profile(const Reading& reading, int component) {
  Profile result;
  const auto along = abscissas(reading);
  for (std::size_t i = 0; i < reading.nodes.size(); ++i) {
    const double value = reading.field.at(reading.nodes[i], component);
    if (std::isnan(value)) continue;
    result.abscissas.push_back(along[i]);
    result.values.push_back(value);
    result.nodes.push_back(reading.nodes[i]);
  }
  if (result.values.empty()) {
    throw DiagnosticError("unknown-component",
                          fmt::format("no node there carries {}", reading.field.components[component]));
  }
  return result;
}

// One row a quantity: the mean along the line, the slope, the extremes and the ends of the straight line of the same
// mean and slope.
void average(Table& table, const Keywords& action, const Reading& reading) {
  const auto components = wanted_components(action, reading.field);
  std::vector<solver::LineMean> means;
  for (const int component : components) {
    const Profile values = profile(reading, component);
    means.push_back(solver::line_mean(values.abscissas, values.values));
  }
  const auto add = [&](const char* quantity, auto&& value_of) {
    Row row = reading.head;
    row.emplace_back("QUANTITE", quantity);
    for (std::size_t i = 0; i < components.size(); ++i)
      row.emplace_back(reading.field.components[components[i]], value_of(means[i]));
    table.add_row(row);
  };
  add("MOMENT_0", [](const auto& mean) { return mean.mean; });
  add("MOMENT_1", [](const auto& mean) { return mean.slope; });
  add("MINIMUM", [](const auto& mean) { return mean.least; });
  add("MAXIMUM", [](const auto& mean) { return mean.greatest; });
  add("MOYE_INT", [](const auto& mean) { return mean.first(); });
  add("MOYE_EXT", [](const auto& mean) { return mean.last(); });
}

void add_mean(Table& table, Row row, const std::string& component, const std::vector<double>& values) {
  row.insert(row.end(), {{"CMP", component}, {"MOYENNE", mean_of(values)}});
  table.add_row(row);
}

void average_of_nodes(Table& table, const Keywords& action, const Reading& reading) {
  for (const int component : wanted_components(action, reading.field))
    add_mean(table, reading.head, reading.field.components[component], profile(reading, component).values);
}

void list_extremes(Table& table, const Keywords& action, const Reading& reading) {
  const auto all = extremes_of(reading.field, wanted_components(action, reading.field), reading.nodes);
  add_extremes(table, reading.head, all, [&](const solver::Extreme& at) {
    return Row{{"NOEUD", table_node(reading.mesh, at.place)}};
  });
}

// --- values as cells have them: only what is extracted is averaged at nodes (U4.81.21)

bool is_of_cells(const Keywords& action, const FieldSource& source, const std::string& operation) {
  const bool is_plain = action.text("REPERE") == "GLOBAL" && !action.has("INVARIANT") && !action.has("ELEM_PRINCIPAUX");
  return is_plain && (operation == "EXTREMA" || operation == "MOYENNE_ARITH") &&
         std::holds_alternative<solver::ElementField>(source.field) && !names_a_place(action, node_places);
}

void add_of_cells(Table& table, const Keywords& action, const FieldSource& source, const std::string& operation) {
  const auto& field = std::get<solver::ElementField>(source.field);
  require_place(action);
  const std::vector<int> cells = selected_cells(action, source.mesh);
  const Row head = head_of_action(action, source);
  const auto where = [&](const solver::Extreme& at) {
    Row row = {{"MAILLE", table_cell(source.mesh, at.place)}};
    if (field.support == solver::Support::element_node)
      row.emplace_back("NOEUD",
                       table_node(source.mesh, source.mesh.cell(at.place)[static_cast<std::size_t>(at.point)]));
    if (field.support == solver::Support::gauss_point) row.emplace_back("POINT", std::int64_t{at.point + 1});
    return row;
  };
  const auto components = chosen_components(action, field.components);
  if (operation == "EXTREMA") {
    add_extremes(table, head, extremes_of(source.field, components, cells), where);
    return;
  }
  for (const int component : components) {
    const std::string& name = field.components[static_cast<std::size_t>(component)];
    std::vector<double> values;
    for (const int cell : cells)
      for (int point = 0; point < field.points(cell); ++point)
        if (const double value = field.at(cell, point, component); !std::isnan(value)) values.push_back(value);
    if (values.empty())
      throw DiagnosticError("unknown-component", fmt::format("POST_RELEVE_T: no cell there carries {}", name),
                            action.span);
    add_mean(table, head, name, values);
  }
}

void check_line(const Keywords& action) {
  const auto operations = action.texts("OPERATION");
  if (!action.has("TOUT") || names_a_place(action, node_places) || names_a_place(action, cell_places)) return;
  if (std::ranges::find(operations, "MOYENNE") == operations.end()) return;
  throw DiagnosticError("excluded-keyword",
                        "POST_RELEVE_T: MOYENNE goes along a line of nodes, which the whole model is not",
                        action.span_of("TOUT"), "give GROUP_NO, or take MOYENNE_ARITH");
}

// Resultants are extracted.
void check_resultant(const Keywords& action) {
  const auto operations = action.texts("OPERATION");
  if (!action.has("RESULTANTE") ||
      std::ranges::all_of(operations, [](const std::string& word) { return word == "EXTRACTION"; }))
    return;
  throw DiagnosticError("excluded-keyword", "POST_RELEVE_T: RESULTANTE goes with OPERATION='EXTRACTION' alone",
                        action.span_of("RESULTANTE"), "name the components by NOM_CMP");
}

void act(Table& table, const Keywords& action, Context& context) {
  check_line(action);
  check_resultant(action);
  warn_of_missing_instants("POST_RELEVE_T", action, context.diagnostics);
  bool first = true;
  const std::size_t before = table.rows.size();
  for (const FieldSource& source : field_sources(action)) {
    if (action.text("MOYE_NOEUD") == "NON") {
      extract_by_cells(table, action, source);
      continue;
    }
    std::vector<std::string> operations = action.texts("OPERATION");
    std::erase_if(operations, [&](const std::string& operation) {
      const bool of_cells = is_of_cells(action, source, operation);
      if (of_cells) add_of_cells(table, action, source, operation);
      return of_cells;
    });
    if (operations.empty()) continue;
    const Reading reading = read(action, source);
    if (std::exchange(first, false)) {
      warn_of_order(action, reading, context);
      warn_of_axis(action, reading, context);
    }
    for (const std::string& operation : operations) {
      if (operation == "EXTRACTION" && action.has("RESULTANTE")) sum(table, action, reading);
      if (operation == "EXTRACTION" && !action.has("RESULTANTE")) extract(table, action, reading);
      if (operation == "MOYENNE") average(table, action, reading);
      if (operation == "MOYENNE_ARITH") average_of_nodes(table, action, reading);
      if (operation == "EXTREMA") list_extremes(table, action, reading);
    }
  }
  if (table.rows.size() == before && !first)
    context.diagnostics.alarm("unknown-component",
                              "POST_RELEVE_T: no node there has a value: the table has no row of it", action.span,
                              "look at where the field is known, and at NOM_CMP");
}

}  // namespace

Product post_releve_t(const Call& call, Context& context) {
  auto product = std::make_shared<TableConcept>();
  for (const Keywords& action : call.factors("ACTION")) act(product->table, action, context);
  return product;
}

}  // namespace comma::commands
