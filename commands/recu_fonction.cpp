#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "commands/analysis/result_reading.hpp"
#include "commands/commands.hpp"
#include "commands/functions/function_building.hpp"
#include "commands/selection.hpp"
#include "commands/tables/table_filter.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

int only_one(const Call& call, const std::vector<int>& found, const char* keyword, const char* what) {
  if (found.size() == 1) return found.front();
  throw DiagnosticError(
      "wrong-count",
      fmt::format("RECU_FONCTION: {} names {} {}s; a function is taken at one", keyword, found.size(), what),
      call.span_of(keyword), "name a group of one");
}

std::vector<int> group_nodes(const Call& call, const solver::Mesh& mesh) {
  return selected_nodes(call, mesh, {"", "GROUP_NO", "NOEUD", "", ""});
}

// A function is taken at one node: the first, where a group has more.
void warn_of_more_nodes(const Call& call, Context& context) {
  if (!call.given("GROUP_NO") || !call.has("RESULTAT")) return;
  const solver::Mesh& mesh = call.data<ResultConcept>("RESULTAT").result.mesh();
  const auto nodes = group_nodes(call, mesh);
  if (nodes.size() < 2) return;
  context.diagnostics.alarm(
      "many-nodes",
      fmt::format("RECU_FONCTION: GROUP_NO names {} nodes; the function is taken at the first, {}", nodes.size(),
                  mesh.node_name(nodes.front())),
      call.span_of("GROUP_NO"), "name a group of one");
}

int node_of(const Call& call, const solver::Mesh& mesh) {
  if (call.given("GROUP_NO") || call.given("NOEUD")) {
    const auto nodes = group_nodes(call, mesh);
    if (nodes.empty())
      throw DiagnosticError("empty-group", "RECU_FONCTION: the group holds no node",
                            call.span_of(call.given("GROUP_NO") ? "GROUP_NO" : "NOEUD"));
    return nodes.front();
  }
  throw DiagnosticError("missing-keyword", "RECU_FONCTION: a field at nodes is read at a node", call.span,
                        "give GROUP_NO");
}

int point_of(const Call& call, const solver::ElementField& field, int cell, const solver::Mesh& mesh) {
  if (field.support == solver::Support::cell) return 0;
  if (call.given("POINT")) {
    const auto point = call.integer("POINT");
    const int points = field.points(cell) / field.values_a_point(cell);
    if (point <= points) return static_cast<int>(point) - 1;
    throw DiagnosticError("out-of-bounds", fmt::format("cell {} has {} points", mesh.cell_name(cell), points),
                          call.span_of("POINT"));
  }
  if (!call.given("GROUP_NO") && !call.given("NOEUD"))
    throw DiagnosticError("missing-keyword", "RECU_FONCTION: a field on cells is read at one of their points",
                          call.span, "give POINT, or the node of the cell where the field is at nodes (..._ELNO)");
  const int node = node_of(call, mesh);
  const auto nodes = mesh.cell(cell);
  const auto found = std::find(nodes.begin(), nodes.end(), node);
  if (found != nodes.end() && field.support == solver::Support::element_node)
    return static_cast<int>(found - nodes.begin());
  throw DiagnosticError("unknown-node",
                        fmt::format("cell {} has no value at node {}", mesh.cell_name(cell), mesh.node_name(node)),
                        call.span, "name a node of the cell and a field at its nodes (..._ELNO), or a POINT");
}

double field_value(const Call& call, const solver::Field& field, const solver::Mesh& mesh) {
  const char* keyword = call.given("NOM_VARI") ? "NOM_VARI" : "NOM_CMP";
  const std::string& component = call.text(keyword);
  if (const auto* nodal = std::get_if<solver::NodalField>(&field)) {
    return nodal->at(node_of(call, mesh), component_of(call, nodal->components, component, keyword));
  }
  const auto& element = std::get<solver::ElementField>(field);
  const int column = component_of(call, element.components, component, keyword);
  if (!call.given("GROUP_MA") && !call.given("MAILLE")) {
    throw DiagnosticError("missing-keyword", "RECU_FONCTION: a field on cells is read on a cell", call.span,
                          "give GROUP_MA and POINT");
  }
  const int cell = only_one(call, selected_cells(call, mesh, {"", "", "", "GROUP_MA", "MAILLE"}),
                            call.given("MAILLE") ? "MAILLE" : "GROUP_MA", "cell");
  if (element.points(cell) == 0) return std::nan("");
  return element.at(
      cell, point_of(call, element, cell, mesh) * element.values_a_point(cell) + sub_point(call, element, cell, mesh),
      column);
}

double carried_value(const Call& call, const solver::Field& field, const solver::Mesh& mesh) {
  const double value = field_value(call, field, mesh);
  if (!std::isnan(value)) return value;
  const char* keyword = call.given("NOM_VARI") ? "NOM_VARI" : "NOM_CMP";
  throw DiagnosticError("unknown-component", "RECU_FONCTION: the field does not carry " + call.text(keyword) + " there",
                        call.span_of(keyword));
}

double step_value(const Call& call, const solver::ResultStep& step, const solver::Mesh& mesh) {
  if (!call.given("NOM_PARA_RESU")) {
    const solver::Field& field = layered_field_of(call, step, call.text("NOM_CHAM"));
    if (!call.given("NOM_VARI")) return carried_value(call, field, mesh);
    return carried_value(
        call, by_variable_names(call, field, call.data<ResultConcept>("RESULTAT").problem_of(step).behaviours.get()),
        mesh);
  }
  const auto found = step.parameters.find(call.text("NOM_PARA_RESU"));
  if (found != step.parameters.end()) return found->second;
  throw DiagnosticError("unknown-parameter", "the result has no parameter " + call.text("NOM_PARA_RESU"),
                        call.span_of("NOM_PARA_RESU"));
}

void read_steps(const Call& call, const std::vector<const solver::ResultStep*>& steps, const solver::Mesh& mesh,
                solver::TabulatedFunction& function) {
  for (const solver::ResultStep* step : steps) {
    function.x.push_back(step->instant);
    function.y.push_back(step_value(call, *step, mesh));
  }
}

// INTERP_NUME='LIN': the instants asked for on the polyline through all steps.
void read_between_steps(const Call& call, const solver::Result& result, solver::TabulatedFunction& function) {
  std::vector<const solver::ResultStep*> steps;
  for (const solver::ResultStep& step : result.steps) steps.push_back(&step);
  solver::TabulatedFunction polyline;
  read_steps(call, steps, result.mesh(), polyline);
  function.x = call.given("LIST_INST") ? call.data<ListConcept>("LIST_INST").values : call.reals("INST");
  for (const double instant : function.x) function.y.push_back(polyline(instant));
}

// Of what says where a value is, that which a field at nodes has no use for.
void warn_of_idle_places_of(const Call& call, interpreter::Diagnostics& diagnostics) {
  if (!call.given("NOM_CHAM")) return;
  const std::vector<solver::ResultStep>& steps = call.data<ResultConcept>("RESULTAT").result.steps;
  const std::string& name = call.text("NOM_CHAM");
  const auto holds_it = [&](const solver::ResultStep& step) {
    return step.fields.contains(name) && std::holds_alternative<solver::NodalField>(step.fields.at(name));
  };
  if (std::ranges::none_of(steps, holds_it)) return;
  constexpr std::array idle = {"GROUP_MA", "MAILLE", "POINT", "SOUS_POINT"};
  commands::warn_of_idle_places("RECU_FONCTION", call, idle, diagnostics);
}

void read_result(const Call& call, solver::TabulatedFunction& function, interpreter::Diagnostics& diagnostics) {
  const solver::Result& result = call.data<ResultConcept>("RESULTAT").result;
  function.parameter = "INST";
  warn_of_idle_places_of(call, diagnostics);
  const bool between = call.text("INTERP_NUME") == "LIN" && (call.given("LIST_INST") || call.given("INST"));
  if (between) {
    read_between_steps(call, result, function);
  } else {
    warn_of_missing_instants("RECU_FONCTION", call, diagnostics);
    read_steps(call, selected_steps(call, result), result.mesh(), function);
  }
}

// The function of a surface that belongs to a value of its first parameter.
void read_surface(const Call& call, solver::TabulatedFunction& function) {
  const auto& surface = call.data<SurfaceConcept>("NAPPE");
  const double wanted = call.real("VALE_PARA_FONC");
  const double reach = call.real("PRECISION") * (call.text("CRITERE") == "RELATIF" ? std::abs(wanted) : 1.0);
  function = surface.row_near(wanted, reach, call.span_of("VALE_PARA_FONC"));
}

// The rows that have a number in both columns.
void read_table(const Call& call, solver::TabulatedFunction& function) {
  Table table = call.data<TableConcept>("TABLE").table;
  for (const Keywords& filter : call.factors("FILTRE")) table = filtered(table, filter);
  const int x = column_of(table, call.text("PARA_X"), call, "PARA_X");
  const int y = column_of(table, call.text("PARA_Y"), call, "PARA_Y");
  std::erase_if(table.rows, [&](const std::vector<Cell>& row) {
    return std::holds_alternative<std::monostate>(row[static_cast<std::size_t>(x)]) ||
           std::holds_alternative<std::monostate>(row[static_cast<std::size_t>(y)]);
  });
  function.parameter = call.text("PARA_X");
  function.x = numbers_in(table, x, call);
  function.y = numbers_in(table, y, call);
}

// A function asks for rising abscissas, a table may have its rows in any order. Of equal ones the function has the
// value of the first row, and steps to that of the last (Code_Aster 17.3); a line beyond them has no slope.
void sort_abscissas(const Call& call, solver::TabulatedFunction& function, interpreter::Diagnostics& diagnostics) {
  function.sort_points();
  const auto& x = function.x;
  const auto twice = std::ranges::adjacent_find(x);
  if (twice == x.end()) return;
  const char* const source = call.given("TABLE") ? "TABLE" : call.given("NAPPE") ? "NAPPE" : "RESULTAT";
  const bool has_slopes = (function.left != solver::Extension::linear || x[0] < x[1]) &&
                          (function.right != solver::Extension::linear || x[x.size() - 2] < x.back());
  if (!has_slopes || call.given("NAPPE")) check_rising(call, source, x);
  diagnostics.alarm(
      "repeated-abscissa",
      fmt::format("RECU_FONCTION: {} = {:g} stands several times: the function has the first of its values "
                  "there, and steps to the last",
                  function.parameter, *twice),
      call.span_of(source), "choose rows by FILTRE where one value is meant");
}

}  // namespace

Product recu_fonction(const Call& call, Context& context) {
  warn_of_more_nodes(call, context);
  solver::TabulatedFunction function;
  if (call.given("NAPPE")) {
    read_surface(call, function);
  } else if (call.given("TABLE")) {
    read_table(call, function);
  } else {
    read_result(call, function, context.diagnostics);
  }
  if (function.x.empty())
    throw DiagnosticError("wrong-count", "RECU_FONCTION: there is no point to make a function of", call.span);
  if (call.has("NOM_PARA")) function.parameter = call.text("NOM_PARA");
  for (const char* name : {"NOM_RESU", "NOM_CMP", "NOM_VARI", "NOM_PARA_RESU", "PARA_Y"}) {
    if (!call.given(name)) continue;
    // Code_Aster's names of results have eight characters: a table of the function has a column ETA_PILO (ssnl133d).
    constexpr std::size_t longest = 8;
    function.result = call.text(name).substr(0, longest);
    break;
  }
  read_shape(call, function);
  sort_abscissas(call, function, context.diagnostics);
  return std::make_shared<TabulatedConcept>(std::move(function));
}

}  // namespace comma::commands
