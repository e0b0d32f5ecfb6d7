#include "commands/tables/extracted_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "commands/methods/method_arguments.hpp"
#include "commands/tables/extracted_column.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/values/array.hpp"
#include "interpreter/values/host_object.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::commands {

namespace {

using interpreter::CallArguments;
using interpreter::Dict;
using interpreter::ErrorKind;
using interpreter::Evaluator;
using interpreter::HostMethod;
using interpreter::HostObject;
using interpreter::Object;
using interpreter::Operator;
using interpreter::raise;
using interpreter::Value;

using RowsPtr = std::shared_ptr<TableRows>;

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

Cell cell_of(const Value& value) {
  if (value.is_none()) return {};
  if (value.is_real()) return value.as_real();
  if (value.is_text()) return value.as_text();
  if (const auto whole = interpreter::small_integer(value)) return *whole;
  raise(ErrorKind::type, "a cell of a table holds a number or a text, not a '" + value.type_name() + "'");
}

Table table_of(const TableRows& rows) {
  Table table{rows.title, rows.columns, {}};
  for (const auto& row : rows.rows) {
    auto& cells = table.rows.emplace_back();
    for (const std::string& name : rows.columns) cells.push_back(cell_of(cell_in(*row, Value(name))));
  }
  return table;
}

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
    if (list == "LISTE_K") entries.emplace_back("TYPE_K", Value(type_of_column(table, c)));
    entries.emplace_back(list, Value::list(std::move(values)));
    lists.push_back(Value::dict(std::move(entries)));
  }
  std::vector<std::pair<std::string, Value>> keywords = {{"LISTE", Value::list(std::move(lists))}};
  if (!table.title.empty()) keywords.insert(keywords.begin(), {"TITRE", Value::list({Value(table.title)})});
  return Value::dict(std::move(keywords));
}

void need_column(const TableRows& table, const std::string& name) {
  if (!table.has(name))
    raise(ErrorKind::key, Value(name).repr(),
          "the columns are " + Value::list({table.columns.begin(), table.columns.end()}).repr());
}

/// The table of these columns; what is empty in all of them is a row no more.
RowsPtr with_columns(const TableRows& table, const std::vector<std::string>& names) {
  auto part = std::make_shared<TableRows>();
  part->title = table.title;
  part->columns = names;
  for (const auto& row : table.rows) {
    auto own = std::make_shared<Dict>();
    for (const std::string& name : names) {
      const Value value = cell_in(*row, Value(name));
      if (!value.is_none()) own->set(Value(name), value);
    }
    if (own->size() > 0) part->rows.push_back(std::move(own));
  }
  return part;
}

void add_row(TableRows& table, const Value& row) {
  if (!row.is_dict()) raise(ErrorKind::type, "a row is a dict, not a '" + row.type_name() + "'");
  for (const Value& name : row.as_dict().keys()) {
    if (!name.is_text()) raise(ErrorKind::type, "a row has names of columns as keys, not " + name.repr());
    if (!table.has(name.as_text())) table.columns.push_back(name.as_text());
  }
  table.rows.push_back(std::get<std::shared_ptr<Dict>>(row.storage()));
}

/// A column of values, one a row; what is left over makes rows of its own.
void add_column(TableRows& table, const std::string& name, const std::vector<Value>& values) {
  if (table.has(name)) raise(ErrorKind::key, "the table has a column " + name + " already");
  if (values.empty()) return;
  table.columns.push_back(name);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i < table.rows.size())
      table.rows[i]->set(Value(name), values[i]);
    else
      add_row(table, Value::dict({{name, values[i]}}));
  }
}

/// Empty cells before numbers before texts, as IMPR_TABLE sorts them.
int rank_of(const Value& value) { return value.is_none() ? 0 : value.is_text() ? 2 : 1; }

bool comes_before(const Value& a, const Value& b) {
  const int left = rank_of(a), right = rank_of(b);
  if (left != right || left == 0) return left < right;
  return interpreter::less_than(a, b);
}

Value sort(TableRows& table, Evaluator&, const MethodArguments& given) {
  const std::vector<std::string> keys = given.has("CLES") ? given.texts("CLES") : table.columns;
  for (const std::string& key : keys) need_column(table, key);
  const std::string order = given.text("ORDRE", "CROISSANT");
  if (order != "CROISSANT" && order != "DECROISSANT")
    raise(ErrorKind::value, "ORDRE is CROISSANT or DECROISSANT, not " + order);
  const bool downwards = order == "DECROISSANT";
  // Rows that tie come in the reverse of their order.
  std::ranges::reverse(table.rows);
  for (auto key = keys.rbegin(); key != keys.rend(); ++key)
    std::ranges::stable_sort(table.rows, [&, name = Value(*key)](const auto& a, const auto& b) {
      const Value left = cell_in(*a, name), right = cell_in(*b, name);
      return downwards ? comes_before(right, left) : comes_before(left, right);
    });
  return Value();
}

Value values_of_table(TableRows& table, Evaluator&, const MethodArguments&) {
  std::vector<std::pair<std::string, Value>> lists;
  for (const std::string& name : table.columns) lists.emplace_back(name, Value::list(table.column(name)));
  return Value::dict(std::move(lists));
}

Value keywords(TableRows& table, Evaluator&, const MethodArguments&) { return keywords_of(table_of(table)); }

Value copied(TableRows& table, Evaluator&, const MethodArguments&) {
  auto twin = std::make_shared<TableRows>(table);
  for (auto& row : twin->rows) {
    auto own = std::make_shared<Dict>();
    for (const Value& name : row->keys()) own->set(name, *row->find(name));
    row = std::move(own);
  }
  return table_value(std::move(twin));
}

Value append(TableRows& table, Evaluator&, const MethodArguments& given) {
  add_row(table, given.value("obj"));
  return Value();
}

Value extend(TableRows& table, Evaluator& evaluator, const MethodArguments& given) {
  for (const Value& row : interpreter::list_of(given.value("objs"), evaluator.meter())) add_row(table, row);
  return Value();
}

/// Two columns side by side.
Value array(TableRows& table, Evaluator&, const MethodArguments& given) {
  std::vector<double> numbers;
  const std::string x = given.needed_text("Para"), y = given.needed_text("Champ");
  need_column(table, x);
  need_column(table, y);
  for (const auto& row : table.rows)
    for (const std::string* name : {&x, &y}) numbers.push_back(interpreter::real_of(cell_in(*row, Value(*name))));
  const std::size_t count = numbers.size() / 2;
  return interpreter::make_value({std::move(numbers), {count, 2}});
}

Value rename(TableRows& table, Evaluator&, const MethodArguments& given) {
  const std::string before = given.needed_text("pold"), after = given.needed_text("pnew");
  need_column(table, before);
  if (table.has(after)) raise(ErrorKind::key, "the table has a column " + after + " already");
  std::ranges::replace(table.columns, before, after);
  for (const auto& row : table.rows) {
    const Value value = cell_in(*row, Value(before));
    if (row->erase(Value(before))) row->set(Value(after), value);
  }
  return Value();
}

/// Of a formula, where the file does not name the columns that its function takes.
std::vector<std::string> parameters_of(const Value& function, Evaluator& evaluator) {
  if (function.is_concept()) {
    const auto& data = function.as_concept()->data;
    if (evaluator.host().force(function.as_concept()) && data->real_function() != nullptr)
      return data->real_function()->parameters();
  }
  raise(ErrorKind::type, "fromfunction() needs the names of the columns that the function takes",
        "give them as third argument");
}

/// A column of what the function gives for the values of others; empty where one of them is.
Value from_function(TableRows& table, Evaluator& evaluator, const MethodArguments& given) {
  const Value function = given.value("funct"), constants = given.value("const");
  const std::vector<std::string> names =
      given.has("l_para") ? given.texts("l_para") : parameters_of(function, evaluator);
  for (const std::string& name : names) need_column(table, name);
  std::vector<Value> made;
  for (const auto& row : table.rows) {
    CallArguments call;
    for (const std::string& name : names) call.positional.push_back(cell_in(*row, Value(name)));
    if (constants.is_dict())
      for (const Value& name : constants.as_dict().keys())
        if (name.is_text()) call.named.push_back({name.as_text(), *constants.as_dict().find(name), {}, {}});
    const bool empty = std::ranges::any_of(call.positional, &Value::is_none);
    made.push_back(empty ? Value() : evaluator.call(function, call));
  }
  add_column(table, given.needed_text("nom_para"), made);
  return Value();
}

Value without_rows_of(TableRows& table, Evaluator&, const MethodArguments& given) {
  const RowsPtr other = rows_behind(given.value("other"));
  if (!other || other->columns != table.columns)
    raise(ErrorKind::type, "difference() takes a table with the same columns");
  return table_value(
      table.where([is_there = other->membership(table.columns)](const Dict& row) { return !is_there(row); }));
}

Value reorder(TableRows& table, Evaluator&, const MethodArguments& given) {
  std::vector<std::string> order;
  for (const std::string& name : given.texts("cols"))
    if (table.has(name)) order.push_back(name);
  for (const std::string& name : table.columns)
    if (std::ranges::find(order, name) == order.end()) order.push_back(name);
  table.columns = std::move(order);
  return Value();
}

Value without_empty_columns(TableRows& table, Evaluator&, const MethodArguments& given) {
  std::vector<std::string> kept;
  for (const std::string& name : given.has("l_para") ? given.texts("l_para") : table.columns)
    if (!std::ranges::all_of(table.column(name), &Value::is_none)) kept.push_back(name);
  return table_value(with_columns(table, kept));
}

struct TableMethod {
  std::vector<std::string> parameters;
  Value (*code)(TableRows&, Evaluator&, const MethodArguments&);
};

const std::map<std::string, TableMethod, std::less<>>& table_methods() {
  static const std::map<std::string, TableMethod, std::less<>> table = {
      {"values", {{}, values_of_table}},
      {"dict_CREA_TABLE", {{}, keywords}},
      {"copy", {{}, copied}},
      {"append", {{"obj"}, append}},
      {"extend", {{"objs"}, extend}},
      {"sort", {{"CLES", "ORDRE"}, sort}},
      {"Array", {{"Para", "Champ"}, array}},
      {"Renomme", {{"pold", "pnew"}, rename}},
      {"fromfunction", {{"nom_para", "funct", "l_para", "const"}, from_function}},
      {"difference", {{"other"}, without_rows_of}},
      {"OrdreColonne", {{"cols"}, reorder}},
      {"SansColonneVide", {{"l_para"}, without_empty_columns}},
  };
  return table;
}

struct TableObject : HostObject {
  explicit TableObject(RowsPtr of) : table(std::move(of)) {}
  RowsPtr table;

  std::string type_name() const override { return "Table"; }
  std::string repr() const override { return format_table(table_of(*table)); }
  std::optional<std::int64_t> length() const override { return static_cast<std::int64_t>(table->rows.size()); }
  std::optional<Value> iterated() const override { return Value::list({table->rows.begin(), table->rows.end()}); }

  std::optional<Value> attribute(std::string_view name) const override {
    if (const auto found = table_methods().find(name); found != table_methods().end())
      return bound(found->first, found->second);
    if (name == "para") return Value::list({table->columns.begin(), table->columns.end()});
    if (name == "rows") return iterated();
    if (name == "titr") return Value(table->title);
    if (table->has(name)) return column_value(table, std::string(name));
    return std::nullopt;
  }
  std::vector<std::string> attribute_names() const override {
    std::vector<std::string> names = table->columns;
    names.insert(names.end(), {"para", "rows", "titr"});
    for (const auto& method : table_methods()) names.push_back(method.first);
    return names;
  }

  /// Rows of both tables, or of either; of tables with the same columns.
  std::optional<Value> combined(Operator op, const Value& other) const override {
    const RowsPtr right = rows_behind(other);
    if (!right || right->columns != table->columns || (op != Operator::bit_and && op != Operator::bit_or))
      return std::nullopt;
    if (op == Operator::bit_and) return table_value(table->where(right->membership(table->columns)));
    auto united = std::make_shared<TableRows>(*table);
    const auto is_there = table->membership(table->columns);
    for (const auto& row : right->rows)
      if (!is_there(*row)) united->rows.push_back(row);
    return table_value(std::move(united));
  }
  /// The table of a column or of several.
  std::optional<Value> item(const Value& index) const override {
    if (!index.is_text() && !index.is_sequence()) return std::nullopt;
    return table_value(with_columns(*table, names_in(index)));
  }
  /// A table of one column looks like that column, and is none.
  std::optional<Value> compared(Operator, const Value& other) const override {
    if (table->columns.size() != 1 || other.is_none()) return std::nullopt;
    raise(ErrorKind::type, "a table cannot be compared, its column can",
          "write T." + table->columns.front() + " for the column itself");
  }
  bool store_item(const Value& index, const Value& value) override {
    if (!index.is_text() || !value.is_sequence()) return false;
    add_column(*table, index.as_text(), {value.items().begin(), value.items().end()});
    return true;
  }
  bool delete_item(const Value& index) override {
    if (!index.is_text() && !index.is_sequence()) return false;
    for (const std::string& name : names_in(index)) {
      std::erase(table->columns, name);
      for (const auto& row : table->rows) row->erase(Value(name));
    }
    return true;
  }

 private:
  std::vector<std::string> names_in(const Value& index) const {
    const std::vector<std::string> names = MethodArguments("[]", {index}, {}, {"column"}).texts("column");
    for (const std::string& name : names) need_column(*table, name);
    return names;
  }
  Value bound(const std::string& name, const TableMethod& method) const {
    const auto code = [name, rows = table, &method](Evaluator& evaluator, const CallArguments& arguments) {
      std::map<std::string, Value> keywords;
      for (const auto& item : arguments.named) keywords.emplace(item.name, item.value);
      return method.code(*rows, evaluator, MethodArguments(name, arguments.positional, keywords, method.parameters));
    };
    return Value(std::shared_ptr<Object>(std::make_shared<HostMethod>(name, code)));
  }
};

}  // namespace

RowsPtr rows_behind(const Value& value) {
  const auto* object = value.as_object<TableObject>();
  return object != nullptr ? object->table : nullptr;
}

Value table_value(RowsPtr rows) {
  return Value(std::shared_ptr<Object>(std::make_shared<TableObject>(std::move(rows))));
}

Value extracted_table(const Table& table) {
  auto rows = std::make_shared<TableRows>();
  rows->title = table.title;
  rows->columns = table.columns;
  for (const auto& cells : table.rows) {
    if (std::ranges::all_of(cells, is_empty)) continue;
    auto row = std::make_shared<Dict>();
    for (std::size_t c = 0; c < cells.size(); ++c) row->set(Value(table.columns[c]), value_of(cells[c]));
    rows->rows.push_back(std::move(row));
  }
  return table_value(std::move(rows));
}

}  // namespace comma::commands
