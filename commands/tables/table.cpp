#include "commands/tables/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "commands/tables/fortran_format.hpp"
#include "commands/tables/row_keys.hpp"

namespace comma::commands {

std::string_view without_padding(std::string_view text) { return text.substr(0, text.find_last_not_of(' ') + 1); }

int Table::column(std::string_view name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

int Table::add_column(const std::string& name) {
  const int known = column(name);
  if (known >= 0) return known;
  columns.push_back(name);
  for (auto& row : rows) row.resize(columns.size());
  return static_cast<int>(columns.size()) - 1;
}

void Table::add_row(const std::vector<std::pair<std::string, Cell>>& cells) {
  std::vector<Cell> row(columns.size());
  for (const auto& [name, cell] : cells) {
    const auto column = static_cast<std::size_t>(add_column(name));
    row.resize(columns.size());
    row[column] = cell;
  }
  rows.push_back(std::move(row));
}

namespace {

std::string format_cell(const Cell& cell, const std::string& real_format) {
  if (const auto* real = std::get_if<double>(&cell)) return format_real(*real, real_format);
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return std::to_string(*integer);
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return "-";
}

}  // namespace

namespace {

/// The kind of a column by its first cell that holds something.
const char* type_of(const Table& table, std::size_t column) {
  for (const auto& row : table.rows) {
    if (std::holds_alternative<double>(row[column])) return "R";
    if (std::holds_alternative<std::int64_t>(row[column])) return "I";
    if (std::holds_alternative<std::string>(row[column])) return "K80";
  }
  return "K8";
}

/// What stands in a column, each once, and where each row of the table comes to stand among that.
struct Entries {
  Entries(const Table& table, std::size_t column) {
    FirstComers known;
    for (const auto& row : table.rows) {
      places.push_back(known.number_of({row[column]}));
      if (places.back() == cells.size()) cells.push_back(row[column]);
    }
  }
  std::vector<Cell> cells;
  std::vector<std::size_t> places;
};

}  // namespace

std::string aster_table(const Table& table, const TableLayout& layout) {
  Table typed = table;
  typed.title.clear();
  std::vector<Cell> types;
  for (std::size_t column = 0; column < table.columns.size(); ++column) types.emplace_back(type_of(table, column));
  typed.rows.insert(typed.rows.begin(), std::move(types));
  std::string text = "#DEBUT_TABLE\n";
  if (!table.title.empty()) text += fmt::format("#TITRE {}\n", table.title);
  return text + format_table(typed, layout) + "#FIN_TABLE\n";
}

Table crossed(const Table& table) {
  const Entries down(table, 0), across(table, 1);
  Table result;
  result.title = fmt::format("{} by {} and {}", table.columns[2], table.columns[0], table.columns[1]);
  result.columns = {fmt::format("{}/{}", table.columns[0], table.columns[1])};
  for (const Cell& cell : across.cells) result.columns.push_back(format_cell(cell, "1PE12.5"));
  for (const Cell& cell : down.cells) {
    result.rows.emplace_back(result.columns.size());
    result.rows.back().front() = cell;
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    result.rows[down.places[i]][1 + across.places[i]] = table.rows[i][2];
  return result;
}

std::string format_table(const Table& table, const TableLayout& layout) {
  std::vector<std::vector<std::string>> lines = {table.columns};
  for (const auto& row : table.rows) {
    auto& line = lines.emplace_back();
    for (const Cell& cell : row) line.push_back(format_cell(cell, layout.real_format));
  }
  std::vector<std::size_t> widths(table.columns.size(), 0);
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  if (!table.title.empty()) text += fmt::format("{} {}\n", layout.comment, table.title);
  for (const auto& line : lines) {
    text += &line == &lines.front() ? layout.names_comment : layout.row_start;
    for (std::size_t i = 0; i < line.size(); ++i) {
      text += fmt::format("{}{:<{}}", layout.separator, line[i], widths[i]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += layout.row_end;
  }
  return text;
}

}  // namespace comma::commands
