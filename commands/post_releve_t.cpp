#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "commands/commands.hpp"
#include "commands/fields/field_reading.hpp"
#include "commands/points.hpp"
#include "commands/selection.hpp"
#include "commands/tables/extreme_rows.hpp"
#include "commands/tables/node_values.hpp"
#include "commands/tables/reductions.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"
#include "solver/fields/data/rotation.hpp"
#include "solver/fields/data/statistics.hpp"
#include "solver/fields/stresses/equivalent.hpp"
#include "solver/mesh/axes.hpp"
#include "solver/mesh/groups.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

constexpr const char* own_name = "POST_RELEVE_T";

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
Place place_of_action(const Keywords& action, const solver::Mesh& mesh) {
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
std::string use_of_order(const Keywords& action, const NodeValues& reading) {
  if (action.has("RESULTANTE")) return {};
  if (action.text("REPERE") == "LOCAL") return "REPERE='LOCAL'";
  const auto operations = action.texts("OPERATION");
  const auto does = [&](const char* word) { return std::ranges::find(operations, word) != operations.end(); };
  if (does("MOYENNE")) return "OPERATION='MOYENNE'";
  return does("EXTRACTION") && solver::lie_on_a_line(reading.mesh, reading.nodes) ? "ABSC_CURV" : "";
}

void warn_of_order(const Keywords& action, const NodeValues& reading, Context& context) {
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
void warn_of_axis(const Keywords& action, const NodeValues& reading, Context& context) {
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

Row label_of_node(const solver::Mesh& mesh, int node) { return {{"NOEUD", table_node(mesh, node)}}; }

NodeValues read(const Keywords& action, const FieldSource& source) {
  auto [nodes, cells] = place_of_action(action, source.mesh);
  solver::NodalField field = at_nodes(action, source, cells.empty() ? nullptr : &cells);
  check_frame(own_name, action, nodes, field);
  NodeValues values{head_of_action(action, source), source.mesh, nodes, nodes, std::move(field), {}};
  values.label = [&mesh = source.mesh, nodes](std::size_t entry) { return label_of_node(mesh, nodes[entry]); };
  // A resultant is turned as a whole.
  if (!action.has("RESULTANTE")) take_wanted_values(own_name, action, nodes, values);
  return values;
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

// MOYE_NOEUD='NON': what a node has from the cells around it is extracted as it is.
bool is_by_cells(const Keywords& action, const std::vector<std::string>& operations) {
  return action.text("MOYE_NOEUD") == "NON" && !action.has("RESULTANTE") &&
         std::ranges::find(operations, "EXTRACTION") != operations.end();
}

// One entry a node and cell around it.
NodeValues read_by_cells(const Keywords& action, const FieldSource& source) {
  const auto* field = std::get_if<solver::ElementField>(&source.field);
  if (field == nullptr || field->support != solver::Support::element_node) {
    throw DiagnosticError("unsupported",
                          "POST_RELEVE_T: MOYE_NOEUD='NON' is for fields at the nodes of cells (..._ELNO)",
                          action.span_of("MOYE_NOEUD"), "leave out MOYE_NOEUD");
  }
  const auto [nodes, cells] = place_of_action(action, source.mesh);
  const auto around = corners_at(source.mesh, *field, cells, nodes);
  NodeValues values{head_of_action(action, source), source.mesh, {}, {}, {field->quantity, field->components, {}}, {}};
  std::vector<int> cell_of_entry;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const auto& [cell, corner] : around[i]) {
      values.rows.push_back(static_cast<int>(values.nodes.size()));
      values.nodes.push_back(nodes[i]);
      cell_of_entry.push_back(cell);
      for (std::size_t c = 0; c < field->components.size(); ++c)
        values.field.values.push_back(field->at(cell, corner, static_cast<int>(c)));
    }
  }
  values.label = [&mesh = source.mesh, at = values.nodes, cell_of_entry](std::size_t entry) {
    Row label = label_of_node(mesh, at[entry]);
    label.emplace_back("MAILLE", table_cell(mesh, cell_of_entry[entry]));
    return label;
  };
  check_frame(own_name, action, values.rows, values.field);
  take_wanted_values(own_name, action, nodes, values);
  return values;
}

// Nothing acts across the plane of plane bodies.
bool is_across_the_plane(const solver::NodalField& field, const std::string& name) {
  return name == "DZ" && field.component("DZ") < 0 && field.component("DX") >= 0;
}

// The vector of forces that components belong to: DX, DY, DZ, or what else ends so (RX, RNX, FX ...).
std::array<std::string, 3> force_components(const Keywords& action, const solver::NodalField& field) {
  std::string stem;
  for (const std::string& name : action.texts("RESULTANTE")) {
    if (!is_across_the_plane(field, name)) component_of(action, field.components, name, "RESULTANTE");
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
void sum(Table& table, const Keywords& action, const NodeValues& reading) {
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
    if (is_across_the_plane(field, name)) {
      row.emplace_back(name, 0.0);
      continue;
    }
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

void add_mean(Table& table, Row row, const std::string& component, const std::vector<double>& values) {
  row.insert(row.end(), {{"CMP", component}, {"MOYENNE", mean_of(values)}});
  table.add_row(row);
}

void average_of_nodes(Table& table, const Keywords& action, const NodeValues& reading) {
  for (const int component : wanted_components(action, reading.field))
    add_mean(table, reading.head, reading.field.components[component], profile(reading, component).values);
}

void list_extremes(Table& table, const Keywords& action, const NodeValues& reading) {
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
    std::vector<std::string> operations = action.texts("OPERATION");
    if (is_by_cells(action, operations)) {
      add_entries(table, action, read_by_cells(action, source));
      std::erase(operations, "EXTRACTION");
    }
    std::erase_if(operations, [&](const std::string& operation) {
      const bool of_cells = is_of_cells(action, source, operation);
      if (of_cells) add_of_cells(table, action, source, operation);
      return of_cells;
    });
    if (operations.empty()) continue;
    const NodeValues reading = read(action, source);
    if (std::exchange(first, false)) {
      warn_of_order(action, reading, context);
      warn_of_axis(action, reading, context);
    }
    for (const std::string& operation : operations) {
      if (operation == "EXTRACTION" && action.has("RESULTANTE")) sum(table, action, reading);
      if (operation == "EXTRACTION" && !action.has("RESULTANTE")) add_entries(table, action, reading);
      if (operation == "MOYENNE") add_line_means(table, action, reading);
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
