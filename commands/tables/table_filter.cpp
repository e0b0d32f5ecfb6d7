#include "commands/tables/table_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "commands/tables/reductions.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

using interpreter::DiagnosticError;
using interpreter::Keywords;

namespace {

/// -1, 0 or 1; two reals that agree within the tolerance count as equal for EQ and NE only.
int order(double value, double reference) { return value < reference ? -1 : value > reference ? 1 : 0; }

bool holds(const std::string& comparison, int order) {
  if (comparison == "LT") return order < 0;
  if (comparison == "LE") return order <= 0;
  if (comparison == "GT") return order > 0;
  if (comparison == "GE") return order >= 0;
  return comparison == "NE" ? order != 0 : order == 0;
}

/// What the cells of a column are compared with, read once.
class Comparison {
 public:
  explicit Comparison(const Keywords& filter) : comparison_(filter.text("CRIT_COMP")) {
    if (filter.given("VALE_K")) {
      for (const std::string& text : filter.texts("VALE_K")) texts_.emplace_back(without_padding(text));
      kind_ = Kind::text;
    } else if (filter.given("VALE_I")) {
      for (const std::int64_t number : filter.integers("VALE_I")) numbers_.push_back(static_cast<double>(number));
      kind_ = Kind::integer;
    } else {
      numbers_ = filter.reals("VALE");
      relative_ = filter.text("CRITERE") == "RELATIF";
      precision_ = filter.real("PRECISION");
    }
  }

  /// An empty cell differs from every value (17.3), and otherwise passes nothing.
  bool passes(const Cell& cell) const {
    if (is_empty(cell)) return comparison_ == "NE";
    if (kind_ == Kind::text) {
      const auto* text = std::get_if<std::string>(&cell);
      if (text == nullptr) return false;
      const std::string_view own = without_padding(*text);
      return over_values(texts_, [&](const std::string& wanted) { return holds(comparison_, own.compare(wanted)); });
    }
    const auto value = number_in(cell);
    return value && over_values(numbers_, [&](double wanted) {
             return kind_ == Kind::integer ? holds(comparison_, order(*value, wanted)) : holds_real(*value, wanted);
           });
  }

 private:
  enum class Kind : std::uint8_t { text, integer, real };

  bool holds_real(double value, double reference) const {
    if (comparison_ != "EQ" && comparison_ != "NE") return holds(comparison_, order(value, reference));
    const bool equal = std::abs(value - reference) <= precision_ * (relative_ ? std::abs(reference) : 1.0);
    return equal == (comparison_ == "EQ");
  }

  /// Several values: one of them for EQ and the orders, none of them for NE.
  template <class Values, class Test>
  bool over_values(const Values& values, Test test) const {
    if (comparison_ == "NE") return std::all_of(values.begin(), values.end(), test);
    return std::any_of(values.begin(), values.end(), test);
  }

  const std::string& comparison_;
  Kind kind_ = Kind::real;
  std::vector<std::string> texts_;
  std::vector<double> numbers_;
  bool relative_ = false;
  double precision_ = 0.0;
};

double ranked(const std::string& comparison, double value) {
  const double size = comparison.ends_with("_ABS") ? std::abs(value) : value;
  return comparison.starts_with("MINI") ? -size : size;
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

int column_of(const Table& table, const std::string& name, const Keywords& keywords, const std::string& keyword) {
  const int column = table.column(name);
  if (column >= 0) return column;
  const std::string near = interpreter::nearest(name, table.columns);
  if (table.columns.empty())
    throw DiagnosticError("unknown-column", "the table is empty: it has no column " + name, keywords.span_of(keyword),
                          "look whether FILTRE has let any row pass");
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
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      part.rows[i].push_back(table.rows[i][static_cast<std::size_t>(column)]);
  }
  return part;
}

Table without_columns(const Table& table, const std::vector<int>& columns) {
  std::vector<int> kept;
  for (int i = 0; i < static_cast<int>(table.columns.size()); ++i) {
    if (std::find(columns.begin(), columns.end(), i) == columns.end()) kept.push_back(i);
  }
  return with_columns(table, kept);
}

Table filtered(const Table& table, const Keywords& filter) {
  const int column = column_of(table, filter.texts("NOM_PARA").front(), filter);
  const std::string& comparison = filter.text("CRIT_COMP");
  if (comparison.starts_with("MAXI") || comparison.starts_with("MINI")) return extremes(table, column, filter);
  Table kept{table.title, table.columns, {}};
  const bool by_emptiness = comparison == "VIDE" || comparison == "NON_VIDE";
  const std::optional<Comparison> compared = by_emptiness ? std::nullopt : std::optional<Comparison>(filter);
  for (const auto& row : table.rows) {
    const Cell& cell = row[static_cast<std::size_t>(column)];
    if (compared ? compared->passes(cell) : is_empty(cell) == (comparison == "VIDE")) kept.rows.push_back(row);
  }
  return kept;
}

void sort_rows(Table& table, const Keywords& keywords) {
  const auto columns = columns_of(table, keywords);
  const bool rising = keywords.text("ORDRE") == "CROISSANT";
  // Rows that tie come in the reverse of their order, rising and falling alike, as in Code_Aster 17.3.
  std::ranges::reverse(table.rows);
  std::ranges::stable_sort(table.rows, [&](const auto& a, const auto& b) {
    for (const int column : columns) {
      const Cell &left = a[static_cast<std::size_t>(column)], &right = b[static_cast<std::size_t>(column)];
      if (stands_before(left, right)) return rising;
      if (stands_before(right, left)) return !rising;
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
      throw DiagnosticError("wrong-type",
                            "column " + table.columns[static_cast<std::size_t>(column)] + " holds texts, not numbers",
                            keywords.span);
    }
  }
  return numbers;
}

}  // namespace comma::commands
