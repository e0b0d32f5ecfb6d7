#include "commands/tables/extracted_column.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "commands/methods/method_arguments.hpp"
#include "interpreter/library/pattern.hpp"
#include "interpreter/values/host_object.hpp"
#include "interpreter/values/operations.hpp"
#include "interpreter/values/repr.hpp"

namespace comma::commands {

using interpreter::Dict;
using interpreter::HostFunction;
using interpreter::HostObject;
using interpreter::Object;
using interpreter::Operator;
using interpreter::Value;

Value cell_in(const Dict& row, const Value& column) {
  const Value* value = row.find(column);
  return value != nullptr ? *value : Value();
}

bool TableRows::has(std::string_view column) const { return std::ranges::find(columns, column) != columns.end(); }

std::vector<Value> TableRows::column(const std::string& name) const {
  std::vector<Value> values;
  for (const auto& row : rows) values.push_back(cell_in(*row, Value(name)));
  return values;
}

std::shared_ptr<TableRows> TableRows::where(const std::function<bool(const Dict&)>& passes) const {
  auto kept = std::make_shared<TableRows>();
  kept->title = title;
  kept->columns = columns;
  for (const auto& row : rows)
    if (passes(*row)) kept->rows.push_back(row);
  return kept;
}

std::function<bool(const Dict&)> TableRows::membership(const std::vector<std::string>& names) const {
  const auto cells = [names](const Dict& row) {
    std::vector<Value> values;
    for (const std::string& name : names) values.push_back(cell_in(row, Value(name)));
    return Value::tuple(std::move(values));
  };
  auto known = std::make_shared<Dict>();
  for (const auto& row : rows) known->set(cells(*row), Value(true));
  return [cells, known](const Dict& row) { return known->find(cells(row)) != nullptr; };
}

namespace {

std::string stripped(const Value& value) {
  const std::string text = interpreter::text_of(value);
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

std::vector<Value> several(const Value& value) {
  return value.is_sequence() ? std::vector<Value>(value.items().begin(), value.items().end())
                             : std::vector<Value>{value};
}

/// Whether a cell is one of the values, texts without the blanks around them. An empty cell is None alone.
bool is_one_of(const Value& cell, const std::vector<Value>& wanted) {
  return std::ranges::any_of(wanted, [&](const Value& each) {
    if (cell.is_none() || each.is_none()) return cell.is_none() && each.is_none();
    return each.is_text() ? stripped(cell) == stripped(each) : interpreter::equal(cell, each);
  });
}

/// Whether a cell lies so to the value; of several the one that lets most pass. An empty cell never does, nor a text to
/// a number.
bool lies_to(const Value& cell, Operator op, const std::vector<Value>& values) {
  return std::ranges::any_of(values, [&](const Value& each) {
    if (cell.is_none() || each.is_none() || cell.is_text() != each.is_text()) return false;
    return interpreter::compare(op, cell, each).as_bool();
  });
}

struct ColumnObject : HostObject {
  ColumnObject(std::shared_ptr<TableRows> whole, std::string which) : table(std::move(whole)), name(std::move(which)) {}
  std::shared_ptr<TableRows> table;
  std::string name;

  std::string type_name() const override { return "Column"; }
  std::string repr() const override { return table_value(alone()).repr(); }
  std::optional<std::int64_t> length() const override { return static_cast<std::int64_t>(table->rows.size()); }
  std::optional<Value> iterated() const override { return Value::list(table->column(name)); }
  std::optional<Value> attribute(std::string_view word) const override;
  std::vector<std::string> attribute_names() const override;

  std::optional<Value> item(const Value& index) const override {
    interpreter::Meter meter{interpreter::Limits{}};
    return interpreter::subscript(*iterated(), index, meter);
  }

  /// The table of the rows that pass.
  std::optional<Value> compared(Operator op, const Value& other) const override {
    const std::vector<Value> values = several(other);
    if (!std::ranges::all_of(values,
                             [](const Value& each) { return each.is_number() || each.is_text() || each.is_none(); }))
      return std::nullopt;
    const bool equality = op == Operator::equal || op == Operator::not_equal;
    return rows_where([&](const Value& cell) {
      return equality ? is_one_of(cell, values) == (op == Operator::equal) : lies_to(cell, op, values);
    });
  }

  Value rows_where(const std::function<bool(const Value&)>& passes) const {
    return table_value(table->where([&, key = Value(name)](const Dict& row) { return passes(cell_in(row, key)); }));
  }
  std::vector<Value> filled() const {
    std::vector<Value> values = table->column(name);
    std::erase_if(values, [](const Value& value) { return value.is_none(); });
    return values;
  }

 private:
  std::shared_ptr<TableRows> alone() const {
    auto part = std::make_shared<TableRows>();
    part->columns = {name};
    part->rows = table->rows;
    return part;
  }
};

/// The rows with the largest value, or the smallest; empty cells left out.
Value extreme_rows(const ColumnObject& column, bool largest) {
  const std::vector<Value> values = column.filled();
  if (values.empty()) interpreter::raise(interpreter::ErrorKind::value, "the column " + column.name + " is empty");
  Value best = values.front();
  for (const Value& value : values)
    if (largest ? interpreter::less_than(best, value) : interpreter::less_than(value, best)) best = value;
  return column.rows_where([&](const Value& cell) { return !cell.is_none() && interpreter::equal(cell, best); });
}

/// The same of the absolute values of the numbers.
Value extreme_sizes(const ColumnObject& column, bool largest) {
  std::optional<double> best;
  for (const Value& value : column.filled()) {
    if (!value.is_number()) continue;
    const double size = std::abs(value.as_real());
    if (!best || (largest ? size > *best : size < *best)) best = size;
  }
  if (!best) interpreter::raise(interpreter::ErrorKind::value, "the column " + column.name + " holds no number");
  return column.rows_where([&](const Value& cell) { return cell.is_number() && std::abs(cell.as_real()) == *best; });
}

struct ColumnMethod {
  std::vector<std::string> parameters;
  Value (*code)(const ColumnObject&, const MethodArguments&);
};

const std::map<std::string, ColumnMethod, std::less<>>& column_methods() {
  using Column = ColumnObject;
  using Given = MethodArguments;
  static const std::map<std::string, ColumnMethod, std::less<>> table = {
      {"values", {{}, [](const Column& column, const Given&) { return *column.iterated(); }}},
      {"not_none_values", {{}, [](const Column& column, const Given&) { return Value::list(column.filled()); }}},
      {"MAXI", {{}, [](const Column& column, const Given&) { return extreme_rows(column, true); }}},
      {"MINI", {{}, [](const Column& column, const Given&) { return extreme_rows(column, false); }}},
      {"MAXI_ABS", {{}, [](const Column& column, const Given&) { return extreme_sizes(column, true); }}},
      {"MINI_ABS", {{}, [](const Column& column, const Given&) { return extreme_sizes(column, false); }}},
      {"VIDE", {{}, [](const Column& column, const Given&) { return column.rows_where(&Value::is_none); }}},
      {"NON_VIDE",
       {{},
        [](const Column& column, const Given&) {
          return column.rows_where([](const Value& cell) { return !cell.is_none(); });
        }}},
      {"REGEXP",
       {{"regexp"},
        [](const Column& column, const Given& given) {
          const std::string pattern = given.needed_text("regexp");
          return column.rows_where(
              [&](const Value& cell) { return cell.is_text() && interpreter::finds_pattern(cell.as_text(), pattern); });
        }}},
  };
  return table;
}

std::optional<Value> ColumnObject::attribute(std::string_view word) const {
  const auto found = column_methods().find(word);
  if (found == column_methods().end()) return std::nullopt;
  const auto code = [own = *this, &method = *found](const std::vector<Value>& arguments) {
    return method.second.code(own, MethodArguments(method.first, arguments, {}, method.second.parameters));
  };
  return Value(std::shared_ptr<Object>(std::make_shared<HostFunction>(found->first, code)));
}

std::vector<std::string> ColumnObject::attribute_names() const { return names_of_methods(column_methods()); }

}  // namespace

Value column_value(std::shared_ptr<TableRows> table, std::string name) {
  return Value(std::shared_ptr<Object>(std::make_shared<ColumnObject>(std::move(table), std::move(name))));
}

}  // namespace comma::commands
