// The rows of an extracted table, and one column of them, which says what rows are meant (U1.03.02).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/values/dict.hpp"
#include "interpreter/values/value.hpp"

namespace comma::commands {

/// What EXTR_TABLE() holds: rows are dicts that the tables made of it share, as in Python.
struct TableRows {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::shared_ptr<interpreter::Dict>> rows;

  bool has(std::string_view column) const;
  /// One value a row, None where it is empty.
  std::vector<interpreter::Value> column(const std::string& name) const;
  /// The same table with the rows that pass.
  std::shared_ptr<TableRows> where(const std::function<bool(const interpreter::Dict&)>& passes) const;
  /// Tells of rows whether one of this table's has the same cells in these columns; of the rows as they are now.
  std::function<bool(const interpreter::Dict&)> membership(const std::vector<std::string>& names) const;
};

/// The cell of a row, None where it is empty.
interpreter::Value cell_in(const interpreter::Dict& row, const interpreter::Value& column);

/// The table as a value of the language; and what is behind such a value, null for any other.
interpreter::Value table_value(std::shared_ptr<TableRows> rows);
std::shared_ptr<TableRows> rows_behind(const interpreter::Value& value);

/// T.INST: see extracted_table().
interpreter::Value column_value(std::shared_ptr<TableRows> table, std::string name);

}  // namespace comma::commands
