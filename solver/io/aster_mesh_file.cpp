// A .mail file is a row of sub-files: a keyword with an optional header, free-format words, FINSF; and FIN at the end
// (U3.01.00). It is read in three strides: words, sub-files, and then the names in them, since a sub-file may use names
// that a later one defines.
#include "solver/io/aster_mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <sstream>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "solver/error.hpp"
#include "solver/io/text_scanner.hpp"
#include "solver/mesh/flatness.hpp"
#include "solver/mesh/nearest_name.hpp"

namespace comma::solver {
namespace {

/// What lies beyond is not read by Code_Aster (U3.01.00, section 1).
constexpr int last_column = 80;

struct Word {
  std::string_view text;
  int line;
  int column;
};

/// Where errors are made, so that each says file, line and column.
class Source {
 public:
  explicit Source(const std::string& path) : path_(path) {}

  [[noreturn]] void fail(const Word& at, const std::string& what, const char* code = "damaged-mesh",
                         const std::string& hint = {}) const {
    throw Error(code, fmt::format("{}:{}:{}: {}", path_, at.line, at.column, what), hint);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error("damaged-mesh", fmt::format("{}: {}", path_, what));
  }

 private:
  const std::string& path_;
};

bool is_separator(char c) { return c == ' ' || c == ',' || c == '\t' || c == '\r' || c == '\f'; }

std::string upper(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

/// Splits one line into words; "=" is a word of its own.
void split_line(std::string_view line, int number, std::vector<Word>& words, const Source& source) {
  line = line.substr(0, line.find('%'));
  std::size_t i = 0;
  while (i < line.size()) {
    if (is_separator(line[i])) {
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    if (line[i] != '=') {
      while (end < line.size() && !is_separator(line[end]) && line[end] != '=') ++end;
    }
    const Word word{line.substr(i, end - i), number, static_cast<int>(i) + 1};
    const bool printable = std::ranges::none_of(word.text, [](unsigned char c) { return c < ' ' || c == 127; });
    if (!printable) source.fail(word, "this is not a text file: there is a control character here");
    if (static_cast<int>(end) > last_column) {
      source.fail(word, fmt::format("the line goes on beyond column {}, where Code_Aster stops reading", last_column),
                  "damaged-mesh", "break the line");
    }
    words.push_back(word);
    i = end;
  }
}

bool starts_title(const std::vector<Word>& words, std::size_t first) {
  return first < words.size() && upper(words[first].text) == "TITRE";
}

/// Titles hold free text, of any length and with any sign: they are left out here, up to their FINSF.
std::vector<Word> split(std::string_view text, const Source& source) {
  std::vector<Word> words;
  int number = 0;
  bool in_title = false;
  bool between = true;  // no sub-file is open
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view line = text.substr(start, end - start);
    start = end + 1;
    ++number;
    const std::size_t first = words.size();
    if (in_title) {
      const std::size_t begin = line.find_first_not_of(" \t\r");
      in_title = begin == std::string_view::npos || upper(line.substr(begin, 5)) != "FINSF";
      continue;
    }
    split_line(line.substr(0, between ? line.find('=') : line.size()), number, words, source);
    if (between && starts_title(words, first)) {
      words.resize(first);
      in_title = true;
      continue;
    }
    if (between && words.size() > first) {
      words.resize(first);
      split_line(line, number, words, source);
    }
    if (words.size() == first) continue;
    if (between && upper(words[first].text) == "FIN") break;
    between = upper(words.back().text) == "FINSF";
  }
  return words;
}

struct Subfile {
  Word keyword;
  std::string name;  ///< from NOM= of the header, else empty
  std::size_t first = 0;
  std::size_t last = 0;  ///< words [first, last) are its content
};

bool ends_subfile(const Word& word) { return upper(word.text) == "FINSF"; }

/// Whether the line that holds words[i] has a "=" in it: then it belongs to the header.
bool is_header_line(const std::vector<Word>& words, std::size_t i) {
  for (std::size_t j = i; j < words.size() && words[j].line == words[i].line; ++j) {
    if (words[j].text == "=") return true;
  }
  return false;
}

/// Reads the lines of the header; only NOM= means anything, and INDEFINI stands for no name.
std::size_t read_header(const std::vector<Word>& words, std::size_t i, Subfile& subfile, const Source& source) {
  while (i < words.size() && !ends_subfile(words[i]) && is_header_line(words, i)) {
    const int line = words[i].line;
    for (; i < words.size() && words[i].line == line; ++i) {
      if (words[i].text != "=" || i == 0 || upper(words[i - 1].text) != "NOM") continue;
      if (i + 1 >= words.size() || words[i + 1].line != line) source.fail(words[i], "NOM= lacks its name");
      if (upper(words[i + 1].text) != "INDEFINI") subfile.name = words[i + 1].text;
    }
  }
  return i;
}

std::vector<Subfile> find_subfiles(const std::vector<Word>& words, const Source& source) {
  std::vector<Subfile> subfiles;
  std::size_t i = 0;
  while (i < words.size()) {
    if (upper(words[i].text) == "FIN") return subfiles;
    Subfile subfile{.keyword = words[i], .name = {}};
    subfile.first = read_header(words, i + 1, subfile, source);
    i = subfile.first;
    while (i < words.size() && !ends_subfile(words[i])) ++i;
    if (i == words.size()) {
      source.fail(subfile.keyword,
                  fmt::format("{} has no FINSF: the file is cut off, or the line is missing", subfile.keyword.text));
    }
    subfile.last = i++;
    subfiles.push_back(std::move(subfile));
  }
  source.fail("the file is cut off: it ends without FIN");
}

double parse_number(const Word& word, const Source& source) {
  std::string text(word.text);
  std::ranges::replace_if(
      text, [](char c) { return c == 'D' || c == 'd'; }, 'e');  // Fortran's double precision
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range)
    source.fail(word, fmt::format("the number {} is out of range", word.text));
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    source.fail(word, fmt::format("a coordinate is expected here, not {}", word.text));
  }
  return value;
}

/// Names of nodes, or of cells, and what they stand for.
class Names {
 public:
  Names(const char* kind, const char* unknown_code) : kind_(kind), unknown_code_(unknown_code) {}

  void add(const Word& word, int index, const Source& source) {
    if (!indices_.emplace(word.text, index).second) {
      source.fail(word, fmt::format("{} {} is defined twice", kind_, word.text));
    }
  }

  int count() const { return static_cast<int>(indices_.size()); }

  std::optional<int> find(std::string_view name) const {
    const auto found = indices_.find(name);
    return found == indices_.end() ? std::nullopt : std::optional(found->second);
  }

  int find(const Word& word, const Source& source) const {
    const auto found = indices_.find(word.text);
    if (found != indices_.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& [name, index] : indices_) known.emplace_back(name);
    std::ranges::sort(known);
    const std::string nearest = nearest_name(word.text, known);
    source.fail(word, fmt::format("there is no {} {}", kind_, word.text), unknown_code_,
                nearest.empty() ? std::string() : fmt::format("did you mean {}?", nearest));
  }

 private:
  const char* kind_;
  const char* unknown_code_;
  std::unordered_map<std::string_view, int> indices_;
};

/// The first of the nodes or cells that is called as another one will be: N7 or M7 but for the seventh.
std::optional<MisleadingName> first_misleading(const Names& names, char letter, int count) {
  for (int i = 0; i < count; ++i) {
    const std::string afterwards = fmt::format("{}{}", letter, i + 1);
    const auto named_so = names.find(afterwards);
    if (named_so && *named_so != i) return MisleadingName{afterwards, fmt::format("{}{}", letter, *named_so + 1)};
  }
  return std::nullopt;
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& path) : source_(path), words_(split(text, source_)) {}

  Mesh parse();
  /// Of what has been parsed.
  std::optional<MisleadingName> misleading_name() const {
    const auto node = first_misleading(node_names_, 'N', node_names_.count());
    return node ? node : first_misleading(cell_names_, 'M', cell_names_.count());
  }

 private:
  struct PendingCells {
    CellType type;
    const Subfile* subfile;
  };
  struct PendingGroup {
    bool of_nodes;
    const Subfile* subfile;
  };

  void sort_subfile(const Subfile& subfile);
  void read_nodes(const Subfile& subfile, int dimension);
  void read_cells(const PendingCells& pending);
  void read_group(const PendingGroup& pending);

  Source source_;
  std::vector<Word> words_;
  std::vector<PendingCells> cells_;
  std::vector<PendingGroup> groups_;
  Names node_names_{"node", "unknown-node"};
  Names cell_names_{"cell", "unknown-cell"};
  Mesh mesh_;
  bool has_coordinates_ = false;
};

void Parser::sort_subfile(const Subfile& subfile) {
  const std::string keyword = upper(subfile.keyword.text);
  if (keyword == "TITRE") return;
  if (keyword == "COOR_2D") return read_nodes(subfile, 2);
  if (keyword == "COOR_3D") return read_nodes(subfile, 3);
  if (keyword == "GROUP_NO") return groups_.push_back({true, &subfile});
  if (keyword == "GROUP_MA") return groups_.push_back({false, &subfile});
  if (const auto type = cell_type_named(keyword)) return cells_.push_back({*type, &subfile});
  static constexpr std::array<std::string_view, 8> shapes = {"POI",   "SEG",   "TRIA",  "QUAD",
                                                             "TETRA", "PYRAM", "PENTA", "HEXA"};
  if (std::ranges::any_of(shapes, [&](std::string_view shape) { return keyword.starts_with(shape); })) {
    source_.fail(subfile.keyword, fmt::format("cells of type {} are not supported", subfile.keyword.text),
                 "unsupported-cell");
  }
  const std::vector<std::string> known = {"TITRE", "COOR_2D", "COOR_3D", "GROUP_NO", "GROUP_MA", "FIN"};
  const std::string nearest = nearest_name(keyword, known);
  source_.fail(subfile.keyword, fmt::format("{} is not a keyword of a mesh file", subfile.keyword.text), "damaged-mesh",
               nearest.empty() ? std::string() : fmt::format("did you mean {}?", nearest));
}

void Parser::read_nodes(const Subfile& subfile, int dimension) {
  if (has_coordinates_ && mesh_.dimension != dimension) {
    source_.fail(subfile.keyword, "COOR_2D and COOR_3D cannot both be in one mesh");
  }
  has_coordinates_ = true;
  mesh_.dimension = dimension;
  const auto width = static_cast<std::size_t>(dimension) + 1;
  for (std::size_t i = subfile.first; i < subfile.last; i += width) {
    if (i + width > subfile.last) {
      source_.fail(words_[i], fmt::format("node {} lacks some of its {} coordinates", words_[i].text, dimension));
    }
    Point point{};
    for (std::size_t j = 1; j < width; ++j) point[j - 1] = parse_number(words_[i + j], source_);
    node_names_.add(words_[i], mesh_.node_count(), source_);
    mesh_.nodes.push_back(point);
  }
}

void Parser::read_cells(const PendingCells& pending) {
  const auto nodes = static_cast<std::size_t>(node_count(pending.type));
  std::vector<int> cell(nodes);
  for (std::size_t i = pending.subfile->first; i < pending.subfile->last; i += nodes + 1) {
    if (i + nodes >= pending.subfile->last) {
      source_.fail(words_[i], fmt::format("cell {} lacks some of its {} nodes", words_[i].text, nodes));
    }
    for (std::size_t j = 0; j < nodes; ++j) cell[j] = node_names_.find(words_[i + 1 + j], source_);
    cell_names_.add(words_[i], mesh_.cell_count(), source_);
    mesh_.add_cell(pending.type, cell);
  }
}

void Parser::read_group(const PendingGroup& pending) {
  const Subfile& subfile = *pending.subfile;
  std::size_t first = subfile.first;
  std::string name = subfile.name;
  if (name.empty()) {
    if (first == subfile.last) source_.fail(subfile.keyword, fmt::format("{} lacks its name", subfile.keyword.text));
    name = words_[first++].text;
  }
  auto& groups = pending.of_nodes ? mesh_.node_groups : mesh_.cell_groups;
  const Names& names = pending.of_nodes ? node_names_ : cell_names_;
  const auto [group, is_new] = groups.try_emplace(name);
  if (!is_new) source_.fail(subfile.keyword, fmt::format("{} {} is defined twice", subfile.keyword.text, name));
  std::vector<bool> seen(static_cast<std::size_t>(pending.of_nodes ? mesh_.node_count() : mesh_.cell_count()), false);
  for (std::size_t i = first; i < subfile.last; ++i) {
    const int index = names.find(words_[i], source_);
    if (!seen[static_cast<std::size_t>(index)]) group->second.push_back(index);
    seen[static_cast<std::size_t>(index)] = true;
  }
}

Mesh Parser::parse() {
  const std::vector<Subfile> subfiles = find_subfiles(words_, source_);
  for (const Subfile& subfile : subfiles) sort_subfile(subfile);
  if (mesh_.nodes.empty()) source_.fail("the mesh has no nodes: COOR_2D or COOR_3D is missing");
  for (const PendingCells& pending : cells_) read_cells(pending);
  for (const PendingGroup& pending : groups_) read_group(pending);
  settle_in_plane(mesh_);
  return std::move(mesh_);
}

}  // namespace

Mesh parse_aster_mesh(std::string_view text, const std::string& path, std::optional<MisleadingName>* misleading) {
  Parser parser(text, path);
  Mesh mesh = parser.parse();
  if (misleading != nullptr) *misleading = parser.misleading_name();
  return mesh;
}

Mesh read_aster_mesh(const std::string& path, std::optional<MisleadingName>* misleading) {
  require_regular_file(path);
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) {
    throw Error("unreadable-file", fmt::format("{}: the file cannot be read, or is empty", path));
  }
  return parse_aster_mesh(text.str(), path, misleading);
}

}  // namespace comma::solver
