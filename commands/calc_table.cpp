#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "commands/commands.hpp"
#include "commands/tables/fortran_format.hpp"
#include "commands/tables/reductions.hpp"
#include "commands/tables/row_keys.hpp"
#include "commands/tables/table_filter.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using interpreter::Value;

/// SUPPRIME takes away what there is, and tells of what is not (17.3 passes over it).
Table suppressed(const Table& table, const Keywords& action, Context& context) {
  std::vector<int> columns;
  for (const std::string& name : action.texts("NOM_PARA")) {
    columns.push_back(table.column(name));
    if (columns.back() >= 0) continue;
    const std::string near = interpreter::nearest(name, table.columns);
    context.diagnostics.alarm("unknown-column",
                              "CALC_TABLE: the table has no column " + name + ", which SUPPRIME is to take away",
                              action.span_of("NOM_PARA"), near.empty() ? "" : "did you mean " + near + "?");
  }
  Table rest = without_columns(table, columns);
  drop_empty_rows(rest);
  return rest;
}

Table extracted(const Table& table, const Keywords& action) {
  Table part = with_columns(table, columns_of(table, action));
  drop_empty_rows(part);
  return part;
}

void rename(Table& table, const Keywords& action) {
  const auto names = action.texts("NOM_PARA");
  const int column = column_of(table, names.front(), action);
  if (table.column(names.back()) >= 0) {
    throw DiagnosticError("repeated-column", "CALC_TABLE: the table already has a column " + names.back(),
                          action.span_of("NOM_PARA"));
  }
  table.columns[static_cast<std::size_t>(column)] = names.back();
}

Cell cell_of(const Value& value, const Keywords& action, const char* keyword = "FORMULE") {
  if (value.is_integer()) return value.as_integer();
  if (value.is_bool()) return static_cast<std::int64_t>(value.as_bool());
  if (value.is_number()) return value.as_real();
  if (value.is_text()) return value.as_text();
  throw DiagnosticError("wrong-type",
                        std::string("CALC_TABLE: ") + keyword + " gives " + value.repr() + ", which no cell holds",
                        action.span_of(keyword));
}

std::vector<Cell> cells_of(const Keywords& action, const char* keyword) {
  std::vector<Cell> cells;
  for (const Value& value : action.at(keyword).value.items()) cells.push_back(cell_of(value, action, keyword));
  return cells;
}

void check_count(const Keywords& action, const char* keyword, std::size_t count, std::size_t wanted, const char* what) {
  if (count == wanted) return;
  throw DiagnosticError("wrong-count",
                        fmt::format("CALC_TABLE: {} has {} values for {} {}", keyword, count, wanted, what),
                        action.span_of(keyword));
}

void add_row(Table& table, const Keywords& action) {
  const auto names = action.texts("NOM_PARA");
  const auto cells = cells_of(action, "VALE");
  check_count(action, "VALE", cells.size(), names.size(), "columns");
  std::vector<std::pair<std::string, Cell>> row;
  for (std::size_t i = 0; i < names.size(); ++i) row.emplace_back(names[i], cells[i]);
  table.add_row(row);
}

// One value a column, or the values of one column, whose last rows stay empty where there are fewer.
void add_columns(Table& table, const Keywords& action) {
  const auto names = action.texts("NOM_PARA");
  for (const std::string& name : names) {
    if (table.column(name) < 0) continue;
    throw DiagnosticError("repeated-column", "CALC_TABLE: the table already has a column " + name,
                          action.span_of("NOM_PARA"));
  }
  const bool by_row = action.given("VALE_COLONNE");
  const char* keyword = by_row ? "VALE_COLONNE" : "VALE";
  const auto cells = cells_of(action, keyword);
  if (by_row) check_count(action, "NOM_PARA", names.size(), 1, "columns of VALE_COLONNE");
  if (!by_row || cells.size() > table.rows.size())
    check_count(action, keyword, cells.size(), by_row ? table.rows.size() : names.size(), by_row ? "rows" : "columns");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto column = static_cast<std::size_t>(table.add_column(names[i]));
    for (std::size_t row = 0; row < (by_row ? cells.size() : table.rows.size()); ++row)
      table.rows[row][column] = cells[by_row ? row : i];
  }
}

// A row in which a variable of the formula is empty gets an empty cell.
void compute(Table& table, const Keywords& action) {
  const auto& function = action.data<FunctionConcept>("FORMULE");
  std::vector<int> sources;
  const bool renamed = action.given("NOM_COLONNE");
  const auto names = renamed ? action.texts("NOM_COLONNE") : function.parameters();
  if (names.size() != function.parameters().size()) {
    throw DiagnosticError("wrong-count",
                          fmt::format("CALC_TABLE: the formula has {} variables, and NOM_COLONNE names {} columns",
                                      function.parameters().size(), names.size()),
                          action.span_of("NOM_COLONNE"));
  }
  for (const std::string& name : names)
    sources.push_back(column_of(table, name, action, renamed ? "NOM_COLONNE" : "FORMULE"));
  if (table.column(action.text("NOM_PARA")) >= 0) {
    throw DiagnosticError("repeated-column", "CALC_TABLE: the table already has a column " + action.text("NOM_PARA"),
                          action.span_of("NOM_PARA"), "give what OPER computes a name of its own");
  }
  const int target = table.add_column(action.text("NOM_PARA"));
  for (auto& row : table.rows) {
    std::vector<Value> arguments;
    for (const int source : sources) {
      const Cell& cell = row[static_cast<std::size_t>(source)];
      if (!is_empty(cell)) arguments.push_back(to_value(cell));
    }
    Cell& result = row[static_cast<std::size_t>(target)];
    result = Cell();
    if (arguments.size() < sources.size()) continue;
    result = cell_of(function.call(arguments), action);
    if (std::isfinite(number_in(result).value_or(0.0))) continue;
    throw DiagnosticError(
        "not-finite",
        fmt::format("CALC_TABLE: the formula gives no finite number in row {}", &row - table.rows.data() + 1),
        action.span_of("FORMULE"), "look for values beyond 1.8e308 in that row");
  }
}

double reduction(const std::string& type, const std::vector<double>& numbers) {
  if (type == "MAXI") return greatest(numbers);
  if (type == "MINI") return least(numbers);
  if (type == "MAXI_ABS") return greatest_size(numbers);
  if (type == "MINI_ABS") return least_size(numbers);
  if (type == "SOMM_ABS") return sum_of_sizes(numbers);
  return type == "SOMM" ? sum_of(numbers) : mean_of(numbers);
}

/// Of integers all but the mean is an integer.
Cell reduced_cell(const Table& table, int column, const std::string& type, const Keywords& action) {
  const auto numbers = numbers_in(table, column, action);
  if (numbers.empty()) return Cell();
  const double value = reduction(type, numbers);
  const bool reals = std::ranges::any_of(table.rows, [&](const auto& row) {
    return std::holds_alternative<double>(row[static_cast<std::size_t>(column)]);
  });
  return reals || type == "MOY" ? Cell(value) : Cell(static_cast<std::int64_t>(value));
}

// Columns as they stand in the table, and last what each row is.
Table reduce(const Table& table, const Keywords& action) {
  Table reduced;
  reduced.title = table.title;
  auto columns = columns_of(table, action);
  std::ranges::sort(columns);
  for (const int column : columns) reduced.columns.push_back(table.columns[static_cast<std::size_t>(column)]);
  reduced.columns.emplace_back("TYPE_CALCUL");
  for (const std::string& type : action.texts("TYPE_CALCUL")) {
    auto& row = reduced.rows.emplace_back();
    for (const int column : columns) row.push_back(reduced_cell(table, column, type, action));
    row.emplace_back(type);
  }
  return reduced;
}

SameKey same_key(const Keywords& action) {
  return action.has("FORMAT_R") ? SameKey(RealFormat(action.text("FORMAT_R"))) : SameKey();
}

// UNIQUE: of the rows that agree in the columns the first.
void keep_different(Table& table, const Keywords& action) {
  const auto columns = columns_of(table, action);
  RowKeys known(columns, same_key(action));
  std::vector<std::vector<Cell>> kept;
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (known.find(table.rows[i], columns)) continue;
    known.add(table.rows[i], i);
    first.push_back(i);
  }
  for (const std::size_t i : first) kept.push_back(std::move(table.rows[i]));
  table.rows = std::move(kept);
}

// STATISTIQUES adds how many rows, columns and empty cells there are, in two columns of its own (U4.33.03).
void add_statistics(Table& table, const Keywords& action) {
  for (const char* name : {"STAT_VALE", "STAT_NOM"}) {
    if (table.column(name) < 0) continue;
    throw DiagnosticError("repeated-column", fmt::format("CALC_TABLE: the table already has a column {}", name),
                          action.span_of("OPERATION"));
  }
  std::int64_t empty = 0;
  for (const auto& row : table.rows) empty += std::ranges::count_if(row, is_empty);
  const std::vector<std::pair<std::string, std::int64_t>> counts = {
      {"NB_LIGNES", static_cast<std::int64_t>(table.rows.size())},
      {"NB_COLONNES", static_cast<std::int64_t>(table.columns.size())},
      {"NB_VIDE", empty}};
  const auto values = static_cast<std::size_t>(table.add_column("STAT_VALE"));
  const auto names = static_cast<std::size_t>(table.add_column("STAT_NOM"));
  if (table.rows.size() < counts.size()) table.rows.resize(counts.size(), std::vector<Cell>(table.columns.size()));
  for (std::size_t i = 0; i < counts.size(); ++i) {
    table.rows[i][values] = counts[i].second;
    table.rows[i][names] = counts[i].first;
  }
}

// It prints as well, column by column of numbers, how many there are, least, greatest, mean and standard deviation.
void show_statistics(const Table& table, const Context& context) {
  for (int column = 0; column < static_cast<int>(table.columns.size()); ++column) {
    std::vector<double> numbers;
    for (const auto& row : table.rows)
      if (const auto number = number_in(row[static_cast<std::size_t>(column)])) numbers.push_back(*number);
    if (numbers.empty()) continue;
    const double mean = reduction("MOY", numbers);
    double square = 0.0;
    for (const double number : numbers) square += (number - mean) * (number - mean);
    context.console.progress(fmt::format("{}: {} values from {:g} to {:g}, mean {:g}, standard deviation {:g}",
                                         table.columns[static_cast<std::size_t>(column)], numbers.size(),
                                         reduction("MINI", numbers), reduction("MAXI", numbers), mean,
                                         std::sqrt(square / static_cast<double>(numbers.size()))));
  }
}

/// COMB: the rows of a table, with those of another one that agree in the key columns, then the others of that one; of
/// another column that both have, the second table's cell stays. Without keys no rows agree (17.3).
class Join {
 public:
  Join(const Table& left, const Table& right, const Keywords& action)
      : right_(right), result_(left), same_(same_key(action)), restricted_(action.text("RESTREINT") == "OUI") {
    for (const std::string& name : action.texts("NOM_PARA")) {
      left_keys_.push_back(column_of(left, name, action));
      right_keys_.push_back(column_of(right, name, action));
    }
    if (!left_keys_.empty() || !restricted_)
      for (const std::string& name : right.columns) targets_.push_back(result_.add_column(name));
  }

  Table run() {
    RowKeys unused(right_keys_, same_);
    for (std::size_t i = 0; i < right_.rows.size() && !right_keys_.empty(); ++i) unused.add(right_.rows[i], i);
    std::vector<bool> used(right_.rows.size(), false);
    std::vector<std::vector<Cell>> rows;
    for (auto& row : result_.rows) {
      const auto match = left_keys_.empty() ? std::nullopt : unused.take(row, left_keys_);
      if (match) {
        fill(row, *match);
        used[*match] = true;
      }
      rows.push_back(std::move(row));
    }
    for (std::size_t i = 0; i < right_.rows.size() && !restricted_; ++i) {
      if (!used[i]) fill(rows.emplace_back(result_.columns.size()), i);
    }
    result_.rows = std::move(rows);
    return std::move(result_);
  }

 private:
  void fill(std::vector<Cell>& row, std::size_t source) const {
    for (std::size_t i = 0; i < targets_.size(); ++i)
      row[static_cast<std::size_t>(targets_[i])] = right_.rows[source][i];
  }

  const Table& right_;
  Table result_;
  SameKey same_;
  bool restricted_;  ///< without rows that the first table has not
  std::vector<int> left_keys_, right_keys_, targets_;
};

/// A column that holds reals and integers holds reals.
void unify_numbers(Table& table) {
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    if (std::ranges::none_of(table.rows, [&](const auto& row) { return std::holds_alternative<double>(row[column]); }))
      continue;
    for (auto& row : table.rows)
      if (const auto* integer = std::get_if<std::int64_t>(&row[column])) row[column] = static_cast<double>(*integer);
  }
}

Table acted(Table table, const Keywords& action, Context& context) {
  const std::string& operation = action.text("OPERATION");
  if (operation == "FILTRE") return filtered(table, action);
  if (operation == "EXTR") return extracted(table, action);
  if (operation == "SUPPRIME") return suppressed(table, action, context);
  if (operation == "CALCUL") return reduce(table, action);
  if (operation == "COMB") return Join(table, action.data<TableConcept>("TABLE").table, action).run();
  if (operation == "RENOMME") rename(table, action);
  if (operation == "TRI") sort_rows(table, action);
  if (operation == "UNIQUE") keep_different(table, action);
  if (operation == "STATISTIQUES") {
    show_statistics(table, context);
    add_statistics(table, action);
  }
  if (operation == "OPER") compute(table, action);
  if (operation == "AJOUT_LIGNE") add_row(table, action);
  if (operation == "AJOUT_COLONNE") add_columns(table, action);
  return table;
}

}  // namespace

Product calc_table(const Call& call, Context& context) {
  auto product = std::make_shared<TableConcept>();
  product->table = call.data<TableConcept>("TABLE").table;
  drop_empty_rows(product->table);
  for (const Keywords& action : call.factors("ACTION"))
    product->table = acted(std::move(product->table), action, context);
  drop_empty(product->table);
  unify_numbers(product->table);
  if (call.has("TITRE")) product->table.title = fmt::format("{}", fmt::join(call.texts("TITRE"), "\n"));
  return product;
}

}  // namespace comma::commands
