#include "commands/tables/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

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

bool is_empty(const Cell& cell) { return std::holds_alternative<std::monostate>(cell); }

std::optional<double> number_in(const Cell& cell) {
  if (const auto* real = std::get_if<double>(&cell)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*integer);
  return std::nullopt;
}

interpreter::Value to_value(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return interpreter::Value(*text);
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return interpreter::Value(*integer);
  const auto* real = std::get_if<double>(&cell);
  return real != nullptr ? interpreter::Value(*real) : interpreter::Value();
}

namespace {

int cell_rank(const Cell& cell) { return is_empty(cell) ? 0 : std::holds_alternative<std::string>(cell) ? 2 : 1; }

}  // namespace

bool stands_before(const Cell& a, const Cell& b) {
  if (cell_rank(a) != cell_rank(b)) return cell_rank(a) < cell_rank(b);
  if (cell_rank(a) == 0) return false;
  if (cell_rank(a) == 2) return std::get<std::string>(a) < std::get<std::string>(b);
  const double left = *number_in(a), right = *number_in(b);
  if (std::isnan(left) || std::isnan(right)) return std::isnan(left) && !std::isnan(right);
  return left < right;
}

void drop_empty_rows(Table& table) {
  std::erase_if(table.rows, [](const auto& row) { return std::ranges::all_of(row, is_empty); });
}

void drop_empty(Table& table) {
  drop_empty_rows(table);
  for (std::size_t column = table.columns.size(); column-- > 0;) {
    const auto place = static_cast<std::ptrdiff_t>(column);
    if (!std::ranges::all_of(table.rows, [&](const auto& row) { return is_empty(row[column]); })) continue;
    table.columns.erase(table.columns.begin() + place);
    for (auto& row : table.rows) row.erase(row.begin() + place);
  }
}

namespace {

constexpr std::size_t number_width = 12;

/// Of Code_Aster's texts.
std::size_t text_width(std::size_t longest) {
  for (const std::size_t width : {8, 16, 24, 32})
    if (longest <= width) return width;
  return 80;
}

std::size_t longest_text(const Table& table, std::size_t column) {
  std::size_t longest = 0;
  for (const auto& row : table.rows)
    if (const auto* text = std::get_if<std::string>(&row[column])) longest = std::max(longest, text->size());
  return longest;
}

}  // namespace

std::string type_of_column(const Table& table, std::size_t column) {
  for (const auto& row : table.rows) {
    if (std::holds_alternative<double>(row[column])) return "R";
    if (std::holds_alternative<std::int64_t>(row[column])) return "I";
    if (std::holds_alternative<std::string>(row[column])) break;
  }
  return fmt::format("K{}", text_width(longest_text(table, column)));
}

namespace {

/// One column of a table as it is written. What is no number is padded on the right to the width of a value first, and
/// then on the left to that of the column, names too.
struct ColumnLook {
  std::string type;
  std::size_t value_width = 0, width = 0;

  std::string operator()(const std::string& text) const {
    return fmt::format("{:>{}}", fmt::format("{:<{}}", text, value_width), width);
  }
  std::string cell(const Cell& cell, const TableLayout& layout) const {
    if (const auto* real = std::get_if<double>(&cell))
      return fmt::format("{:>{}}", format_real(*real, layout.real_format), width);
    if (const auto* integer = std::get_if<std::int64_t>(&cell)) return fmt::format("{:>{}}", *integer, width);
    const auto* text = std::get_if<std::string>(&cell);
    return (*this)(text != nullptr ? *text : layout.empty);
  }
};

ColumnLook look_of(const Table& table, std::size_t column, const TableLayout& layout) {
  ColumnLook look{type_of_column(table, column)};
  const bool is_text = look.type.starts_with("K");
  const auto real_width = static_cast<std::size_t>(RealFormat(layout.real_format).width());
  look.value_width = is_text ? text_width(longest_text(table, column)) : look.type == "R" ? real_width : number_width;
  // A scale factor is a letter more.
  const std::size_t scale = layout.real_format.find_first_of("pP") == std::string::npos ? 0 : 1;
  const std::size_t least = is_text ? look.value_width : std::max(number_width, real_width + scale);
  look.width = std::max(table.columns[column].size(), least);
  for (const auto& row : table.rows) look.width = std::max(look.width, look.cell(row[column], layout).size());
  return look;
}

std::string title_lines(const std::string& title, const TableLayout& layout) {
  std::string text = fmt::format("{0}\n{0}{1:-<80}\n", layout.comment, "");
  if (title.empty()) return text;
  text += layout.comment;
  for (std::size_t from = 0; from <= title.size();) {
    const std::size_t end = std::min(title.find('\n', from), title.size());
    text += layout.row_start + layout.comment + title.substr(from, end - from) + layout.row_end;
    from = end + 1;
  }
  return text;
}

/// The names, the types where they are asked for, and a line a row.
std::string body_of(const Table& table, const TableLayout& layout, bool with_types) {
  std::vector<ColumnLook> looks;
  for (std::size_t i = 0; i < table.columns.size(); ++i) looks.push_back(look_of(table, i, layout));
  const auto line = [&](auto&& text_of) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < looks.size(); ++i) texts.push_back(text_of(i));
    return fmt::format("{}{}{}", layout.row_start, fmt::join(texts, layout.separator), layout.row_end);
  };
  // Where blanks do not part the columns, names are not padded.
  const bool padded = layout.separator.find(' ') != std::string::npos;
  std::string text = line([&](std::size_t i) {
    return (i == 0 ? layout.names_comment : "") + (padded ? looks[i](table.columns[i]) : table.columns[i]);
  });
  if (with_types) text += line([&](std::size_t i) { return looks[i](looks[i].type); });
  for (const auto& row : table.rows) text += line([&](std::size_t i) { return looks[i].cell(row[i], layout); });
  return text;
}

/// What stands in a column, each once and rising, and where each row of the table comes to stand among that.
struct Entries {
  Entries(const Table& table, std::size_t column) {
    FirstComers known;
    for (const auto& row : table.rows) {
      places.push_back(known.number_of({row[column]}));
      if (places.back() == cells.size()) cells.push_back(row[column]);
    }
    std::vector<std::size_t> order(cells.size()), rank(cells.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return stands_before(cells[a], cells[b]); });
    const std::vector<Cell> as_they_come = cells;
    for (std::size_t i = 0; i < order.size(); ++i) {
      cells[i] = as_they_come[order[i]];
      rank[order[i]] = i;
    }
    for (std::size_t& place : places) place = rank[place];
  }
  std::vector<Cell> cells;
  std::vector<std::size_t> places;
};

}  // namespace

std::string shown_cell(const Cell& cell) {
  if (const auto* real = std::get_if<double>(&cell)) return interpreter::Value(*real).repr();
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return std::to_string(*integer);
  const auto* text = std::get_if<std::string>(&cell);
  return text != nullptr ? *text : "-";
}

std::string aster_table(const Table& table, const TableLayout& layout) {
  TableLayout indented = layout;
  indented.row_start = layout.row_start + " ";
  std::string text = title_lines("", layout) + fmt::format("{0}{0}DEBUT_TABLE\n", layout.comment);
  for (std::size_t from = 0; from < table.title.size();) {
    const std::size_t end = std::min(table.title.find('\n', from), table.title.size());
    text += fmt::format("#TITRE {}\n", table.title.substr(from, end - from));
    from = end + 1;
  }
  return text + body_of(table, indented, true) + "#FIN_TABLE\n";
}

Table crossed(const Table& table) {
  const Entries across(table, 0), down(table, 1);
  Table result;
  result.title = fmt::format("{}{}{} FONCTION DE {} ET {}", table.title, table.title.empty() ? "" : "\n",
                             table.columns[2], table.columns[1], table.columns[0]);
  result.columns = {fmt::format("{}/{}", table.columns[1], table.columns[0])};
  for (const Cell& cell : across.cells) result.columns.push_back(shown_cell(cell));
  for (const Cell& cell : down.cells) {
    result.rows.emplace_back(result.columns.size());
    result.rows.back().front() = cell;
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    result.rows[down.places[i]][1 + across.places[i]] = table.rows[i][2];
  return result;
}

std::string format_table(const Table& table, const TableLayout& layout) {
  return title_lines(table.title, layout) + body_of(table, layout, false);
}

}  // namespace comma::commands
