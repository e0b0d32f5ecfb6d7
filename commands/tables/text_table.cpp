#include "commands/tables/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"

namespace comma::commands {

namespace {

using Words = std::vector<std::string>;

std::string stripped(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

Words split(const std::string& line, const std::string& separator) {
  Words words;
  if (stripped(separator).empty()) {
    std::istringstream stream(line);
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
  }
  std::size_t from = 0;
  for (std::size_t at = line.find(separator); at != std::string::npos; at = line.find(separator, from)) {
    words.push_back(stripped(line.substr(from, at - from)));
    from = at + separator.size();
  }
  words.push_back(stripped(line.substr(from)));
  // A separator before the first or behind the last column.
  if (!words.empty() && words.front().empty()) words.erase(words.begin());
  return words;
}

// Exponents may be written with D, as Fortran does.
std::optional<double> real_in(std::string word) {
  std::ranges::replace(word, 'D', 'E');
  std::ranges::replace(word, 'd', 'e');
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* last = word.data() + word.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, last, value);
  return error == std::errc() && end == last && first != last ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> integer_in(const std::string& word) {
  std::int64_t value = 0;
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* last = word.data() + word.size();
  const auto [end, error] = std::from_chars(first, last, value);
  return error == std::errc() && end == last && first != last ? std::optional(value) : std::nullopt;
}

bool is_empty(const std::string& word) { return word.empty() || word == "-"; }

enum class ColumnKind : std::uint8_t { integers, reals, texts };

Cell cell_of(const std::string& word, ColumnKind kind) {
  if (is_empty(word)) return Cell();
  if (kind == ColumnKind::integers)
    if (const auto value = integer_in(word)) return Cell(*value);
  if (kind != ColumnKind::texts)
    if (const auto value = real_in(word)) return Cell(*value);
  if (kind == ColumnKind::texts) return Cell(word);
  throw solver::Error("unreadable-table", fmt::format("{} is no number, as the type of its column says", word));
}

ColumnKind kind_of(const std::vector<Words>& rows, std::size_t column) {
  const auto all = [&](auto&& holds) {
    return std::ranges::all_of(rows, [&](const Words& row) { return is_empty(row[column]) || holds(row[column]); });
  };
  if (all([](const std::string& word) { return integer_in(word).has_value(); })) return ColumnKind::integers;
  if (all([](const std::string& word) { return real_in(word).has_value(); })) return ColumnKind::reals;
  return ColumnKind::texts;
}

// Names that stand twice get a number: DX, DX_1.
Words unique_names(Words names) {
  Words made;
  for (const std::string& name : names) {
    std::string own = name;
    for (int k = 1; std::ranges::count(made, own) != 0; ++k) own = fmt::format("{}_{}", name, k);
    made.push_back(own);
  }
  return made;
}

void require_width(const Words& row, const Words& names, const std::string& line) {
  if (row.size() == names.size()) return;
  throw solver::Error("unreadable-table",
                      fmt::format("{} columns have names, and {} values stand in the line \"{}\"", names.size(),
                                  row.size(), stripped(line)),
                      "look at SEPARATEUR, and for texts with blanks");
}

Table filled(const std::string& title, const Words& names, const std::vector<Words>& rows,
             const std::vector<ColumnKind>& kinds) {
  Table table;
  table.title = title;
  table.columns = unique_names(names);
  for (const Words& row : rows) {
    auto& cells = table.rows.emplace_back();
    for (std::size_t column = 0; column < row.size(); ++column) cells.push_back(cell_of(row[column], kinds[column]));
  }
  return table;
}

[[noreturn]] void tell_missing_table(int number, int found) {
  throw solver::Error("unknown-table", fmt::format("the file has {} tables, and number {} is asked for", found, number),
                      "look at NUME_TABLE and FORMAT");
}

}  // namespace

std::ifstream open_input(const interpreter::Call& call, Context& context, const std::vector<std::string>& extensions) {
  const auto path = context.files.input(static_cast<int>(call.integer("UNITE")), extensions);
  std::ifstream file(path);
  if (!file)
    throw interpreter::DiagnosticError("missing-file", fmt::format("{}: cannot read {}", call.command, path.string()),
                                       call.span);
  context.console.progress("  reads " + path.string());
  return file;
}

Table read_aster_table(std::istream& file, const std::string& separator, int number) {
  int found = 0;
  std::string line;
  while (std::getline(file, line))
    if (line.find("#DEBUT_TABLE") != std::string::npos && ++found == number) break;
  if (found < number) tell_missing_table(number, found);
  std::string title;
  Words names;
  std::vector<ColumnKind> kinds;
  std::vector<Words> rows;
  while (std::getline(file, line) && line.find("#FIN_TABLE") == std::string::npos) {
    if (line.starts_with("#TITRE")) title += (title.empty() ? "" : "\n") + stripped(line.substr(6));
    if (line.starts_with("#") || stripped(line).empty()) continue;
    const Words words = split(line, separator);
    if (names.empty()) {
      names = words;
      continue;
    }
    require_width(words, names, line);
    if (!kinds.empty()) {
      rows.push_back(words);
      continue;
    }
    for (const std::string& type : words)
      kinds.push_back(type == "I" ? ColumnKind::integers : type == "R" ? ColumnKind::reals : ColumnKind::texts);
  }
  return filled(title, names, rows, kinds);
}

Table read_plain_table(std::istream& file, const std::string& separator, int number) {
  int found = 0;
  std::string title;
  Words names;
  std::vector<Words> rows;
  bool is_inside = false;
  for (std::string line; std::getline(file, line);) {
    // Tables that follow each other are apart by an empty line or a comment.
    if (line.starts_with("#") || stripped(line).empty()) {
      if (is_inside && found == number) break;
      if (is_inside) title.clear();
      is_inside = false;
      const std::string comment =
          stripped(line.substr(std::min<std::size_t>(line.find_first_not_of('#'), line.size())));
      if (line.starts_with("#") && !comment.empty() && comment.find_first_not_of('-') != std::string::npos)
        title += (title.empty() ? "" : "\n") + comment;
      continue;
    }
    const Words words = split(line, separator);
    if (!is_inside) {
      is_inside = true;
      ++found;
      names = words;
      continue;
    }
    if (found != number) continue;
    require_width(words, names, line);
    rows.push_back(words);
  }
  if (found < number) tell_missing_table(number, found);
  std::vector<ColumnKind> kinds;
  for (std::size_t column = 0; column < names.size(); ++column) kinds.push_back(kind_of(rows, column));
  return filled(title, names, rows, kinds);
}

std::vector<NumberBlock> read_number_blocks(std::istream& file, const std::string& separator) {
  std::vector<NumberBlock> blocks;
  bool is_inside = false;
  for (std::string line; std::getline(file, line);) {
    std::vector<double> row;
    const Words words = split(line, separator);
    const bool is_row = !words.empty() && std::ranges::all_of(words, [&](const std::string& word) {
      const auto value = real_in(word);
      if (value) row.push_back(*value);
      return value.has_value();
    });
    if (!is_row) {
      is_inside = false;
      continue;
    }
    if (!is_inside) blocks.emplace_back();
    is_inside = true;
    blocks.back().push_back(row);
  }
  return blocks;
}

}  // namespace comma::commands
