#include <fmt/format.h>

#include <cmath>

#include "commands/commands.hpp"
#include "commands/result_reading.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

double distance(const solver::Point& a, const solver::Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// A row by column names; a column that is new to the table is empty in the rows before.
void add_row(Table& table, const std::vector<std::pair<std::string, Cell>>& cells) {
  std::vector<Cell> row(table.columns.size());
  for (const auto& [name, cell] : cells) {
    const auto column = static_cast<std::size_t>(table.add_column(name));
    row.resize(table.columns.size());
    row[column] = cell;
  }
  table.rows.push_back(std::move(row));
}

// One row a node that carries any of the components, with the place, the curvilinear abscissa along the list of nodes and
// the values (U4.81.21).
void add_rows(Table& table, const Keywords& action, const std::vector<int>& nodes, const solver::Mesh& mesh,
              const solver::ResultStep& step, const solver::NodalField& field, const std::vector<int>& components) {
  const std::string title = action.has("INTITULE") ? action.text("INTITULE") : "";
  double abscissa = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const solver::Point& at = mesh.nodes[nodes[i]];
    if (i > 0) abscissa += distance(mesh.nodes[nodes[i - 1]], at);
    std::vector<std::pair<std::string, Cell>> row = {{"INTITULE", title},
                                                     {"NOEUD", mesh.node_name(nodes[i])},
                                                     {"RESU", action.concept_of("RESULTAT")->name},
                                                     {"NOM_CHAM", action.text("NOM_CHAM")},
                                                     {"NUME_ORDRE", static_cast<std::int64_t>(step.order)},
                                                     {"INST", step.instant},
                                                     {"ABSC_CURV", abscissa},
                                                     {"COOR_X", at[0]},
                                                     {"COOR_Y", at[1]},
                                                     {"COOR_Z", at[2]}};
    bool carried = false;
    for (const int component : components) {
      const double value = field.at(nodes[i], component);
      carried |= !std::isnan(value);
      row.emplace_back(field.components[component], std::isnan(value) ? Cell() : Cell(value));
    }
    if (carried) add_row(table, row);
  }
}

std::vector<int> wanted_components(const Keywords& action, const solver::NodalField& field) {
  std::vector<int> components;
  if (action.given("NOM_CMP")) {
    for (const std::string& name : action.texts("NOM_CMP")) components.push_back(component_of(action, field.components, name));
    return components;
  }
  for (std::size_t i = 0; i < field.components.size(); ++i) components.push_back(static_cast<int>(i));
  return components;
}

void extract(Table& table, const Keywords& action) {
  const auto& concept_data = interpreter::data_of<ResultConcept>(action.concept_of("RESULTAT"), "RESULTAT");
  const solver::Mesh& mesh = concept_data.result.mesh();
  const auto nodes = selected_nodes(action, mesh);
  for (const solver::ResultStep* step : selected_steps(action, concept_data.result)) {
    const auto* field = std::get_if<solver::NodalField>(&field_of(action, *step));
    if (field == nullptr) {
      throw DiagnosticError("unsupported", "POST_RELEVE_T: " + action.text("NOM_CHAM") + " is a field on elements, not on nodes",
                            action.span_of("NOM_CHAM"), "give a field on nodes (..._NOEU, DEPL, FORC_NODA ...)");
    }
    const auto components = wanted_components(action, *field);
    add_rows(table, action, nodes, mesh, *step, *field, components);
  }
}

}  // namespace

Product post_releve_t(const Call& call, Context&) {
  auto product = std::make_shared<TableConcept>();
  for (const Keywords& action : call.factors("ACTION")) extract(product->table, action);
  return product;
}

}  // namespace comma::commands
