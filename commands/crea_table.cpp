#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "commands/commands.hpp"
#include "commands/fields/field_reading.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_room.hpp"
#include "solver/fields/data/field_rows.hpp"
#include "solver/fields/points/discretisation.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// The letters that TYPE_K leaves of a text; a letter of several bytes stays whole.
std::string cut_text(const std::string& text, std::size_t width) {
  std::size_t end = std::min(width, text.size());
  while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end);
}

void add_texts(std::vector<Cell>& cells, const Keywords& list, interpreter::Diagnostics& diagnostics) {
  if (!list.given("LISTE_K")) return;
  const std::string& type = list.text("TYPE_K");
  const auto width = static_cast<std::size_t>(std::stoi(type.substr(1)));
  bool told = false;
  for (const std::string& text : list.texts("LISTE_K")) {
    cells.emplace_back(cut_text(text, width));
    if (told || without_padding(text).size() <= width) continue;
    told = true;
    diagnostics.alarm("cut-text",
                      fmt::format("CREA_TABLE: texts of the column {} are cut to {} letters, \"{}\" to \"{}\"",
                                  list.text("PARA"), width, text, cut_text(text, width)),
                      list.span_of("LISTE_K"), "write TYPE_K='K24', or K80 for still longer ones");
  }
}

std::vector<Cell> cells_of(const Keywords& list, interpreter::Diagnostics& diagnostics) {
  std::vector<Cell> cells;
  for (const double value : list.reals("LISTE_R")) cells.emplace_back(value);
  for (const auto value : list.integers("LISTE_I")) cells.emplace_back(value);
  add_texts(cells, list, diagnostics);
  return cells;
}

void put(Table& table, std::size_t row, int column, Cell cell) {
  if (row >= table.rows.size()) table.rows.resize(row + 1, std::vector<Cell>(table.columns.size()));
  table.rows[row][static_cast<std::size_t>(column)] = std::move(cell);
}

void add_list(Table& table, const Keywords& list, interpreter::Diagnostics& diagnostics) {
  const std::string& name = list.text("PARA");
  if (table.column(name) >= 0)
    throw DiagnosticError("repeated-column", "CREA_TABLE: two lists are named " + name, list.span_of("PARA"));
  const int column = table.add_column(name);
  const auto cells = cells_of(list, diagnostics);
  const auto rows = list.integers("NUME_LIGN");
  constexpr std::int64_t most_rows = 1'000'000;
  if (!rows.empty() && *std::ranges::max_element(rows) > most_rows) {
    throw DiagnosticError("out-of-bounds", fmt::format("CREA_TABLE: a table has {} rows at most", most_rows),
                          list.span_of("NUME_LIGN"));
  }
  if (!rows.empty() && rows.size() != cells.size()) {
    throw DiagnosticError("wrong-count",
                          fmt::format("CREA_TABLE: {} rows stand against {} values", rows.size(), cells.size()),
                          list.span_of("NUME_LIGN"));
  }
  if (std::set<std::int64_t>(rows.begin(), rows.end()).size() < rows.size())
    throw DiagnosticError("repeated-row", "CREA_TABLE: NUME_LIGN names a row twice", list.span_of("NUME_LIGN"),
                          "give each value a row of its own");
  for (std::size_t i = 0; i < cells.size(); ++i)
    put(table, rows.empty() ? i : static_cast<std::size_t>(rows[i] - 1), column, cells[i]);
}

void add_function(Table& table, const Keywords& source) {
  const auto* function = source.data<FunctionConcept>("FONCTION").table();
  if (function == nullptr) {
    throw DiagnosticError("unsupported",
                          fmt::format("CREA_TABLE: {} is not given by points", source.concept_of("FONCTION")->name),
                          source.span_of("FONCTION"), "tabulate it by CALC_FONC_INTERP");
  }
  auto names = source.texts("PARA");
  if (names.empty()) names = {function->parameter, function->result};
  const int x = table.add_column(names.front()), y = table.add_column(names.back());
  for (std::size_t i = 0; i < function->x.size(); ++i) {
    put(table, i, x, function->x[i]);
    put(table, i, y, function->y[i]);
  }
}

// One row for values that are not all absent.
template <class ValueAt>
void add_values(Table& table, Row row, const solver::Field& field, const std::vector<int>& components,
                ValueAt value_at) {
  bool carried = false;
  for (const int component : components) {
    const double value = value_at(component);
    carried |= !std::isnan(value);
    row.emplace_back(solver::components_of(field)[static_cast<std::size_t>(component)],
                     std::isnan(value) ? Cell() : Cell(value));
  }
  if (carried) table.add_row(row);
}

void add_place(Row& row, double x, double y, double z) {
  row.insert(row.end(), {{"COOR_X", x}, {"COOR_Y", y}, {"COOR_Z", z}});
}

Row head_of(const Keywords& source, const FieldSource& from) {
  Row head = from.columns;
  for (auto& [column, cell] : head)
    if (column == "RESU") column = "RESULTAT";
  // The instant stands before the number of the step (17.3).
  const auto column = [&](const char* name) {
    return std::ranges::find(head, name, &std::pair<std::string, Cell>::first);
  };
  if (const auto instant = column("INST"); instant != head.end() && column("NUME_ORDRE") < instant)
    std::rotate(column("NUME_ORDRE"), instant, instant + 1);
  if (source.has("INTITULE")) head.insert(head.begin(), {"INTITULE", source.text("INTITULE")});
  return head;
}

void add_nodes(Table& table, const Keywords& source, const FieldSource& from, const std::vector<int>& components) {
  const auto& field = std::get<solver::NodalField>(from.field);
  std::vector<int> nodes = selected_nodes(source, from.mesh);
  std::ranges::sort(nodes);
  for (const int node : nodes) {
    Row row = head_of(source, from);
    const solver::Point& at = from.mesh.nodes[node];
    row.emplace_back("NOEUD", table_node(from.mesh, node));
    add_place(row, at[0], at[1], at[2]);
    add_values(table, std::move(row), from.field, components, [&](int component) { return field.at(node, component); });
  }
}

// Where the values of a field on cells lie, as components 0 to 2; empty where that is not known.
solver::ElementField places_of(const FieldSource& from, const solver::ElementField& field) {
  if (from.model == nullptr || field.support == solver::Support::cell) return {};
  return solver::brought_to(*from.model, solver::node_coordinates(from.mesh), field.support, true);
}

void add_cells(Table& table, const Keywords& source, const FieldSource& from, const std::vector<int>& components) {
  const auto& field = std::get<solver::ElementField>(from.field);
  for (const char* keyword : {"GROUP_NO", "NOEUD"}) {
    if (!source.given(keyword)) continue;
    throw DiagnosticError("wrong-place",
                          fmt::format("CREA_TABLE: {} names nodes, and the field lies on cells", keyword),
                          source.span_of(keyword), "name cells by TOUT, GROUP_MA or MAILLE");
  }
  const solver::ElementField places = places_of(from, field);
  for (const int cell : selected_cells(source, from.mesh)) {
    const int each = field.values_a_point(cell);
    const bool placed = !places.starts.empty() && places.points(cell) == field.points(cell) / each;
    for (int value = 0; value < field.points(cell); ++value) {
      const int point = value / each;
      Row row = head_of(source, from);
      row.emplace_back("MAILLE", table_cell(from.mesh, cell));
      if (field.support == solver::Support::element_node)
        row.emplace_back("NOEUD", table_node(from.mesh, from.mesh.cell(cell)[point]));
      if (field.support == solver::Support::gauss_point)
        row.emplace_back("POINT", static_cast<std::int64_t>(point + 1));
      row.emplace_back("SOUS_POINT", static_cast<std::int64_t>(value % each + 1));
      if (placed) add_place(row, places.at(cell, point, 0), places.at(cell, point, 1), places.at(cell, point, 2));
      add_values(table, std::move(row), from.field, components,
                 [&](int component) { return field.at(cell, value, component); });
    }
  }
}

std::vector<int> known_indices(const Keywords& source, const std::vector<std::string>& all,
                               interpreter::Diagnostics& diagnostics) {
  std::vector<int> indices;
  for (const std::string& name : known_components(source, all, diagnostics))
    indices.push_back(component_of(source, all, name));
  return indices;
}

// One row a node, by rising numbers, or a value of a cell, that carries any of the components (U4.33.02).
void add_field(Table& table, const Keywords& source, interpreter::Diagnostics& diagnostics) {
  for (const FieldSource& from : field_sources(source, ValuesAPoint::any)) {
    const std::vector<std::string>& all = solver::components_of(from.field);
    const std::vector<int> components =
        source.given("NOM_CMP") ? known_indices(source, all, diagnostics) : chosen_components(source, all);
    if (std::holds_alternative<solver::NodalField>(from.field)) {
      add_nodes(table, source, from, components);
    } else {
      add_cells(table, source, from, components);
    }
  }
}

}  // namespace

Product crea_table(const Call& call, Context& context) {
  auto product = std::make_shared<TableConcept>();
  for (const Keywords& list : call.factors("LISTE")) add_list(product->table, list, context.diagnostics);
  for (const Keywords& source : call.factors("FONCTION")) add_function(product->table, source);
  for (const Keywords& source : call.factors("RESU")) {
    warn_of_missing_instants("CREA_TABLE", source, context.diagnostics);
    add_field(product->table, source, context.diagnostics);
  }
  if (call.has("TITRE")) product->table.title = fmt::format("{}", fmt::join(call.texts("TITRE"), "\n"));
  return product;
}

}  // namespace comma::commands
