#include "commands/table_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "commands/reductions.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

bool is_empty(const Cell& cell) { return std::holds_alternative<std::monostate>(cell); }

/// -1, 0 or 1; two reals that agree within the tolerance count as equal for EQ and NE only.
int order(double value, double reference) { return value < reference ? -1 : value > reference ? 1 : 0; }

bool holds(const std::string& comparison, int order) {
  if (comparison == "LT") return order < 0;
  if (comparison == "LE") return order <= 0;
  if (comparison == "GT") return order > 0;
  if (comparison == "GE") return order >= 0;
  return comparison == "NE" ? order != 0 : order == 0;
}

bool holds_number(const Keywords& filter, double value, double reference) {
  const std::string& comparison = filter.text("CRIT_COMP");
  if (comparison != "EQ" && comparison != "NE") return holds(comparison, order(value, reference));
  const double scale = filter.text("CRITERE") == "RELATIF" ? std::abs(reference) : 1.0;
  const bool equal = std::abs(value - reference) <= filter.real("PRECISION") * scale;
  return equal == (comparison == "EQ");
}

/// Several values: one of them for EQ and the orders, none of them for NE.
template <class Values, class Test>
bool over_values(const Keywords& filter, const Values& values, Test test) {
  if (filter.text("CRIT_COMP") == "NE") return std::all_of(values.begin(), values.end(), test);
  return std::any_of(values.begin(), values.end(), test);
}

bool passes(const Keywords& filter, const Cell& cell) {
  if (filter.given("VALE_K")) {
    const auto* text = std::get_if<std::string>(&cell);
    if (text == nullptr) return false;
    return over_values(filter, filter.texts("VALE_K"), [&](const std::string& wanted) {
      return holds(filter.text("CRIT_COMP"), without_padding(*text).compare(without_padding(wanted)));
    });
  }
  const auto value = number_in(cell);
  if (!value) return false;
  if (filter.given("VALE_I")) {
    return over_values(filter, filter.integers("VALE_I"), [&](std::int64_t wanted) {
      return holds(filter.text("CRIT_COMP"), order(*value, static_cast<double>(wanted)));
    });
  }
  return over_values(filter, filter.reals("VALE"), [&](double wanted) { return holds_number(filter, *value, wanted); });
}

double ranked(const std::string& comparison, double value) {
  const double size = comparison.ends_with("_ABS") ? std::abs(value) : value;
  return comparison.starts_with("MINI") ? -size : size;
}

/// Numbers before texts, empty cells last, whatever the order of each kind.
int rank(const Cell& cell) { return std::holds_alternative<std::monostate>(cell) ? 2 : std::holds_alternative<std::string>(cell) ? 1 : 0; }

bool less(const Cell& a, const Cell& b) {
  if (rank(a) != rank(b)) return rank(a) < rank(b);
  if (rank(a) == 2) return false;
  if (rank(a) == 1) return std::get<std::string>(a) < std::get<std::string>(b);
  return *number_in(a) < *number_in(b);
}

Table extremes(const Table& table, int column, const Keywords& filter) {
  const std::string& comparison = filter.text("CRIT_COMP");
  auto numbers = numbers_in(table, column, filter);
  Table kept{table.title, table.columns, {}};
  if (numbers.empty()) return kept;
  for (double& number : numbers) number = ranked(comparison, number);
  const double best = greatest(numbers);
  for (const auto& row : table.rows) {
    const auto value = number_in(row[static_cast<std::size_t>(column)]);
    if (value && ranked(comparison, *value) == best) kept.rows.push_back(row);
  }
  return kept;
}

}  // namespace

std::optional<double> number_in(const Cell& cell) {
  if (const auto* real = std::get_if<double>(&cell)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*integer);
  return std::nullopt;
}

int column_of(const Table& table, const std::string& name, const Keywords& keywords, const std::string& keyword) {
  const int column = table.column(name);
  if (column >= 0) return column;
  const std::string near = interpreter::nearest(name, table.columns);
  throw DiagnosticError("unknown-column", "the table has no column " + name, keywords.span_of(keyword),
                        near.empty() ? "" : "did you mean " + near + "?");
}

std::vector<int> columns_of(const Table& table, const Keywords& keywords) {
  std::vector<int> columns;
  for (const std::string& name : keywords.texts("NOM_PARA")) columns.push_back(column_of(table, name, keywords));
  return columns;
}

Table with_columns(const Table& table, const std::vector<int>& columns) {
  Table part;
  part.title = table.title;
  part.rows.resize(table.rows.size());
  for (const int column : columns) {
    part.columns.push_back(table.columns[static_cast<std::size_t>(column)]);
    for (std::size_t i = 0; i < table.rows.size(); ++i) part.rows[i].push_back(table.rows[i][static_cast<std::size_t>(column)]);
  }
  return part;
}

Table filtered(const Table& table, const Keywords& filter) {
  const int column = column_of(table, filter.texts("NOM_PARA").front(), filter);
  const std::string& comparison = filter.text("CRIT_COMP");
  if (comparison.starts_with("MAXI") || comparison.starts_with("MINI")) return extremes(table, column, filter);
  Table kept{table.title, table.columns, {}};
  for (const auto& row : table.rows) {
    const Cell& cell = row[static_cast<std::size_t>(column)];
    const bool keep = comparison == "VIDE" ? is_empty(cell) : comparison == "NON_VIDE" ? !is_empty(cell) : passes(filter, cell);
    if (keep) kept.rows.push_back(row);
  }
  return kept;
}

void sort_rows(Table& table, const Keywords& keywords) {
  const auto columns = columns_of(table, keywords);
  const bool upwards = keywords.text("ORDRE") == "CROISSANT";
  std::stable_sort(table.rows.begin(), table.rows.end(), [&](const auto& a, const auto& b) {
    for (const int column : columns) {
      const Cell &left = a[static_cast<std::size_t>(column)], &right = b[static_cast<std::size_t>(column)];
      if (less(left, right)) return upwards;
      if (less(right, left)) return !upwards;
    }
    return false;
  });
}

std::vector<double> numbers_in(const Table& table, int column, const Keywords& keywords) {
  std::vector<double> numbers;
  for (const auto& row : table.rows) {
    const Cell& cell = row[static_cast<std::size_t>(column)];
    if (const auto number = number_in(cell)) {
      numbers.push_back(*number);
    } else if (!is_empty(cell)) {
      throw DiagnosticError("wrong-type", "column " + table.columns[static_cast<std::size_t>(column)] + " holds texts, not numbers", keywords.span);
    }
  }
  return numbers;
}

}  // namespace comma::commands
