#include "commands/concepts.hpp"

#include "commands/tables/extracted_table.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/values/value.hpp"

namespace comma::commands {

Value TableConcept::subscript(const Value& key) const {
  const bool shaped =
      key.is_tuple() && key.items().size() == 2 && key.items()[0].is_text() && key.items()[1].is_integer();
  if (!shaped) {
    throw interpreter::DiagnosticError("type-error", "a table is read by column name and row number", {},
                                       "write TABLE[\"COLUMN\", 1]; rows count from 1");
  }
  const std::string& name = key.items()[0].as_text();
  const std::int64_t row = key.items()[1].as_integer();
  const int column = table.column(name);
  if (column < 0) {
    const std::string near = interpreter::nearest(name, table.columns);
    throw interpreter::DiagnosticError("key-error", "the table has no column " + name, {},
                                       near.empty() ? "" : "did you mean " + near + "?");
  }
  if (row < 1 || row > static_cast<std::int64_t>(table.rows.size())) {
    throw interpreter::DiagnosticError(
        "key-error", "the table has no row " + std::to_string(row) + "; it has " + std::to_string(table.rows.size()));
  }
  return std::visit(
      [](const auto& cell) -> Value {
        using T = std::decay_t<decltype(cell)>;
        if constexpr (std::is_same_v<T, std::monostate>) {
          return Value();
        } else {
          return Value(cell);
        }
      },
      table.rows[row - 1][column]);
}

Value ListConcept::method(std::string_view name, const std::vector<Value>& arguments,
                          const std::map<std::string, Value>& keywords) const {
  if ((name == "Valeurs" || name == "getValues") && arguments.empty() && keywords.empty()) return list_of(values);
  return ConceptData::method(name, arguments, keywords);
}

Value IntegerListConcept::method(std::string_view name, const std::vector<Value>& arguments,
                                 const std::map<std::string, Value>& keywords) const {
  if ((name == "Valeurs" || name == "getValues") && arguments.empty() && keywords.empty())
    return Value::list({values.begin(), values.end()});
  return ConceptData::method(name, arguments, keywords);
}

std::vector<std::string> TableConcept::method_names() const {
  return {"EXTR_TABLE", "get_nom_para", "getParameters", "getNumberOfLines"};
}

Value TableConcept::method(std::string_view name, const std::vector<Value>& arguments,
                           const std::map<std::string, Value>& keywords) const {
  if (!arguments.empty() || !keywords.empty()) return ConceptData::method(name, arguments, keywords);
  if (name == "EXTR_TABLE") return extracted_table(table);
  if (name == "get_nom_para" || name == "getParameters")
    return Value::list({table.columns.begin(), table.columns.end()});
  if (name == "getNumberOfLines") return Value(static_cast<std::int64_t>(table.rows.size()));
  return ConceptData::method(name, arguments, keywords);
}

}  // namespace comma::commands
