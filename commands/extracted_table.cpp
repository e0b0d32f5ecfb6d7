#include "commands/extracted_table.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "commands/table_filter.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/host_object.hpp"
#include "interpreter/operations.hpp"

namespace comma::commands {

namespace {

using interpreter::HostFunction;
using interpreter::HostObject;
using interpreter::Object;
using interpreter::Operator;
using interpreter::Value;

Value value_of(const Cell& cell) {
  return std::visit(
      [](const auto& held) -> Value {
        if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>) {
          return Value();
        } else {
          return Value(held);
        }
      },
      cell);
}

Value column_values(const Table& table, int column) {
  std::vector<Value> values;
  for (const auto& row : table.rows) values.push_back(value_of(row[static_cast<std::size_t>(column)]));
  return Value::list(std::move(values));
}

Value as_object(std::shared_ptr<Object> object) { return Value(std::move(object)); }

template <class Code>
Value method(const char* name, Code&& code) {
  return as_object(std::make_shared<HostFunction>(name, [name, code](const std::vector<Value>& arguments) {
    if (!arguments.empty()) throw interpreter::DiagnosticError("type-error", std::string(name) + "() takes no arguments");
    return code();
  }));
}

/// Whether a cell lies to a value as the operator says; an empty one never does, and texts without the blanks behind them.
bool passes(const Cell& cell, Operator op, const Value& value) {
  if (std::holds_alternative<std::monostate>(cell)) return false;
  const auto* text = std::get_if<std::string>(&cell);
  if ((text != nullptr) != value.is_text()) return op == Operator::not_equal;
  if (text == nullptr) return interpreter::compare(op, value_of(cell), value).as_bool();
  const auto trimmed = [](const std::string& each) { return each.substr(0, each.find_last_not_of(' ') + 1); };
  return interpreter::compare(op, trimmed(*text), trimmed(value.as_text())).as_bool();
}

template <class Keep>
Value rows_that(const Table& table, const Keep& keep) {
  Table kept{table.title, table.columns, {}};
  for (const auto& row : table.rows)
    if (keep(row)) kept.rows.push_back(row);
  return extracted_table(kept);
}

struct ColumnObject : HostObject {
  ColumnObject(std::shared_ptr<const Table> whole, int place) : table(std::move(whole)), column(place) {}
  std::shared_ptr<const Table> table;
  int column;

  std::string type_name() const override { return "Column"; }
  std::string repr() const override {
    Table alone;
    alone.columns = {table->columns[static_cast<std::size_t>(column)]};
    for (const auto& row : table->rows) alone.rows.push_back({row[static_cast<std::size_t>(column)]});
    return format_table(alone);
  }
  std::optional<Value> attribute(std::string_view name) const override {
    if (name != "values") return std::nullopt;
    return method("values", [whole = table, place = column] { return column_values(*whole, place); });
  }
  std::vector<std::string> attribute_names() const override { return {"values"}; }
  /// The table of the rows that pass (U1.03.02).
  std::optional<Value> compared(Operator op, const Value& other) const override {
    if (!other.is_number() && !other.is_text()) return std::nullopt;
    return rows_that(*table, [&](const std::vector<Cell>& row) { return passes(row[static_cast<std::size_t>(column)], op, other); });
  }
  std::optional<std::int64_t> length() const override { return static_cast<std::int64_t>(table->rows.size()); }
};

/// What CREA_TABLE makes the table of again: a list a column, with the numbers of its rows where some are empty.
Value keywords_of(const Table& table) {
  std::vector<Value> lists;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::vector<Value> values, rows;
    std::string list = "LISTE_I";
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      const Cell& cell = table.rows[r][c];
      if (std::holds_alternative<std::monostate>(cell)) continue;
      if (std::holds_alternative<double>(cell) && list == "LISTE_I") list = "LISTE_R";
      if (std::holds_alternative<std::string>(cell)) list = "LISTE_K";
      values.push_back(value_of(cell));
      rows.emplace_back(static_cast<std::int64_t>(r + 1));
    }
    if (values.empty()) continue;
    std::vector<std::pair<std::string, Value>> entries = {{"PARA", Value(table.columns[c])}};
    if (rows.size() < table.rows.size()) entries.emplace_back("NUME_LIGN", Value::list(std::move(rows)));
    if (list == "LISTE_K") entries.emplace_back("TYPE_K", Value("K24"));
    entries.emplace_back(list, Value::list(std::move(values)));
    lists.push_back(Value::dict(std::move(entries)));
  }
  return Value::dict({{"LISTE", Value::list(std::move(lists))}});
}

struct TableObject : HostObject {
  explicit TableObject(const Table& of) : table(std::make_shared<const Table>(of)) {}
  std::shared_ptr<const Table> table;

  std::string type_name() const override { return "Table"; }
  std::string repr() const override { return format_table(*table); }
  std::optional<std::int64_t> length() const override { return static_cast<std::int64_t>(table->rows.size()); }

  std::optional<Value> attribute(std::string_view name) const override {
    if (const int column = table->column(name); column >= 0) return as_object(std::make_shared<ColumnObject>(table, column));
    if (name == "values") return method("values", [whole = table] { return columns_of(*whole); });
    if (name == "para") return Value::list({table->columns.begin(), table->columns.end()});
    if (name == "rows") return rows();
    if (name == "dict_CREA_TABLE") return method("dict_CREA_TABLE", [whole = table] { return keywords_of(*whole); });
    return std::nullopt;
  }
  std::vector<std::string> attribute_names() const override {
    std::vector<std::string> names = table->columns;
    names.insert(names.end(), {"values", "para", "rows", "dict_CREA_TABLE"});
    return names;
  }

  /// Rows of both tables, or of either, each once; of tables with the same columns.
  std::optional<Value> combined(Operator op, const Value& other) const override {
    const auto* right = other.as_object<TableObject>();
    if (right == nullptr || right->table->columns != table->columns || (op != Operator::bit_and && op != Operator::bit_or)) return std::nullopt;
    const auto holds = [](const Table& each, const std::vector<Cell>& row) { return std::ranges::find(each.rows, row) != each.rows.end(); };
    if (op == Operator::bit_and) return rows_that(*table, [&](const std::vector<Cell>& row) { return holds(*right->table, row); });
    Table united = *table;
    for (const auto& row : right->table->rows)
      if (!holds(united, row)) united.rows.push_back(row);
    return extracted_table(united);
  }
  /// The column of a name, or the table of those of several.
  std::optional<Value> item(const Value& index) const override {
    if (index.is_text()) return as_object(std::make_shared<ColumnObject>(table, place_of(index)));
    if (!index.is_sequence()) return std::nullopt;
    std::vector<int> places;
    for (const Value& name : index.items()) places.push_back(place_of(name));
    return extracted_table(with_columns(*table, places));
  }
  int place_of(const Value& name) const {
    const int column = name.is_text() ? table->column(name.as_text()) : -1;
    if (column < 0) interpreter::raise(interpreter::ErrorKind::key, name.repr());
    return column;
  }

  static Value columns_of(const Table& table) {
    std::vector<std::pair<std::string, Value>> columns;
    for (std::size_t c = 0; c < table.columns.size(); ++c) columns.emplace_back(table.columns[c], column_values(table, static_cast<int>(c)));
    return Value::dict(std::move(columns));
  }
  Value rows() const {
    std::vector<Value> rows;
    for (const auto& row : table->rows) {
      std::vector<std::pair<std::string, Value>> cells;
      for (std::size_t c = 0; c < row.size(); ++c)
        if (!std::holds_alternative<std::monostate>(row[c])) cells.emplace_back(table->columns[c], value_of(row[c]));
      rows.push_back(Value::dict(std::move(cells)));
    }
    return Value::list(std::move(rows));
  }
};

}  // namespace

Value extracted_table(const Table& table) { return as_object(std::make_shared<TableObject>(table)); }

}  // namespace comma::commands
