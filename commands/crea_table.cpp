#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

std::vector<Cell> cells_of(const Keywords& list) {
  std::vector<Cell> cells;
  for (const double value : list.reals("LISTE_R")) cells.emplace_back(value);
  for (const auto value : list.integers("LISTE_I")) cells.emplace_back(value);
  for (const auto& value : list.texts("LISTE_K")) cells.emplace_back(value);
  return cells;
}

void put(Table& table, std::size_t row, int column, Cell cell) {
  if (row >= table.rows.size()) table.rows.resize(row + 1, std::vector<Cell>(table.columns.size()));
  table.rows[row][static_cast<std::size_t>(column)] = std::move(cell);
}

void add_list(Table& table, const Keywords& list) {
  const std::string& name = list.text("PARA");
  if (table.column(name) >= 0) throw DiagnosticError("repeated-column", "CREA_TABLE: two lists are named " + name, list.span_of("PARA"));
  const int column = table.add_column(name);
  const auto cells = cells_of(list);
  const auto rows = list.integers("NUME_LIGN");
  if (!rows.empty() && rows.size() != cells.size()) {
    throw DiagnosticError("wrong-count", fmt::format("CREA_TABLE: {} rows stand against {} values", rows.size(), cells.size()),
                          list.span_of("NUME_LIGN"));
  }
  for (std::size_t i = 0; i < cells.size(); ++i) put(table, rows.empty() ? i : static_cast<std::size_t>(rows[i] - 1), column, cells[i]);
}

void add_function(Table& table, const Keywords& source) {
  const auto* function = source.data<FunctionConcept>("FONCTION").table();
  if (function == nullptr) {
    throw DiagnosticError("unsupported", fmt::format("CREA_TABLE: {} is not given by points", source.concept_of("FONCTION")->name),
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

}  // namespace

Product crea_table(const Call& call, Context&) {
  auto product = std::make_shared<TableConcept>();
  for (const Keywords& list : call.factors("LISTE")) add_list(product->table, list);
  for (const Keywords& source : call.factors("FONCTION")) add_function(product->table, source);
  if (call.has("TITRE")) product->table.title = fmt::format("{}", fmt::join(call.texts("TITRE"), "\n# "));
  return product;
}

}  // namespace comma::commands
