// A table as commands exchange it: named columns, rows of cells that may be empty.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "interpreter/values/value.hpp"

namespace comma::commands {

using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;
/// Cells by the names of their columns.
using Row = std::vector<std::pair<std::string, Cell>>;

/// Code_Aster's texts have fixed lengths: blanks at their ends do not count.
std::string_view without_padding(std::string_view text);

/// Whether `a` stands before `b` where they are sorted: empty cells, numbers, texts.
bool stands_before(const Cell& a, const Cell& b);

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

bool is_empty(const Cell& cell);
/// The number of a cell; nothing where it holds a text, or nothing.
std::optional<double> number_in(const Cell& cell);
/// A cell as the language has it, None of an empty one.
interpreter::Value to_value(const Cell& cell);
/// Takes away rows in which every cell is empty; and columns too.
void drop_empty_rows(Table& table);
void drop_empty(Table& table);

/// What a column holds: "I", "R", or the shortest of the texts K8, K16, K24, K32 and K80 that holds all of them.
std::string type_of_column(const Table& table, std::size_t column);

/// How a table is written.
struct TableLayout {
  std::string separator = " ";        ///< between columns
  std::string real_format = "E12.5";  ///< of Fortran
  std::string comment = "#";          ///< before each line of the title
  std::string names_comment = {};     ///< before the line of the names
  std::string row_start = {};
  std::string row_end = "\n";
  std::string empty = "-";  ///< in place of what is empty
};

/// The table in Code_Aster's own format (FORMAT='ASTER' of IMPR_TABLE, read again by LIRE_TABLE, U7.02.03): between
/// #DEBUT_TABLE and #FIN_TABLE the title, the names, their types I, R, K8 ... K80, a line a row.
std::string aster_table(const Table& table, const TableLayout& layout = {});

/// A table of two entries out of three columns: a column for each value of the first, a row for each of the second,
/// rising, in between the third; empty where there is none.
Table crossed(const Table& table);

/// A cell as titles and names show it: 1.0, 1, A.
std::string shown_cell(const Cell& cell);

/// The table as IMPR_TABLE writes it (as Code_Aster 17.3 does, to the blank): a line of dashes and the title as
/// comments, the column names, a line a row. Numbers stand right in at least 12 letters, texts left in as many as their
/// type has.
std::string format_table(const Table& table, const TableLayout& layout = {});

}  // namespace comma::commands
