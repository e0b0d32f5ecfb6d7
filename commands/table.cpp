#include "commands/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "commands/fortran_format.hpp"

namespace comma::commands {

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
