// A table as commands exchange it: named columns, rows of cells that may be empty.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace comma::commands {

using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;
/// Cells by the names of their columns.
using Row = std::vector<std::pair<std::string, Cell>>;

/// Code_Aster's texts have fixed lengths: blanks at their ends do not count.
std::string_view without_padding(std::string_view text);

/// Every row has as many cells as there are columns.
struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;

  /// Index of a column, -1 if there is none.
  int column(std::string_view name) const;
  /// Index of a column, added (empty in every row) if there is none.
  int add_column(const std::string& name);
  /// Adds a row given by column names; a column that is new is empty in the rows before.
  void add_row(const std::vector<std::pair<std::string, Cell>>& cells);
};

/// How a table is written.
struct TableLayout {
  std::string separator = " ";        ///< before each column
  std::string real_format = "E12.5";  ///< of Fortran
  std::string comment = "#";          ///< before the title
  std::string names_comment;          ///< before the line of the names
  std::string row_start;
  std::string row_end = "\n";
};

/// The table in Code_Aster's own format (FORMAT='ASTER' of IMPR_TABLE, read again by LIRE_TABLE, U7.02.03): between
/// #DEBUT_TABLE and #FIN_TABLE the title, the names, their types I, R or K80, a line a row.
std::string aster_table(const Table& table, const TableLayout& layout = {});

/// A table of two entries out of three columns: a row for each value of the first, a column for each of the second, in
/// between the third; empty where there is none.
Table crossed(const Table& table);

/// The table as aligned text: the title behind the comment sign, the column names, a line a row; an empty cell is "-".
std::string format_table(const Table& table, const TableLayout& layout = {});

}  // namespace comma::commands
