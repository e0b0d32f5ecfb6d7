#include "solver/io/ideas_mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "solver/error.hpp"
#include "solver/io/cells_by_type.hpp"
#include "solver/io/text_scanner.hpp"
#include "solver/mesh/flatness.hpp"

namespace comma::solver {
namespace {

constexpr std::array node_sets = {15, 781, 2411};
constexpr std::array cell_sets = {780, 2412};
// Of pairs (kind, number), and of quadruples whose last two numbers do not count.
constexpr std::array pair_group_sets = {752, 2417, 2429, 2430, 2432};
constexpr std::array quadruple_group_sets = {2435, 2452, 2467, 2477};

constexpr int most_members = 500'000'000;

bool contains(const auto& numbers, int wanted) { return std::ranges::find(numbers, wanted) != numbers.end(); }

/// Elements of lines say in a further record how they lie about themselves.
bool is_line(int descriptor) { return contains(std::array{11, 21, 22, 23, 24}, descriptor); }

/// A cell type and, for each of its nodes, where the file has it: middle nodes stand there between their corners, layer
/// by layer.
struct IdeasCell {
  CellType type;
  std::vector<int> order;
};

std::optional<IdeasCell> solid_of(int descriptor) {
  using enum CellType;
  switch (descriptor) {
    case 111:
      return IdeasCell{tetra4, {}};
    case 112:
      return IdeasCell{penta6, {}};
    case 113:
      return IdeasCell{penta15, {0, 2, 4, 9, 11, 13, 1, 3, 5, 6, 7, 8, 10, 12, 14}};
    case 115:
      return IdeasCell{hexa8, {}};
    case 116:
      return IdeasCell{hexa20, {0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 8, 9, 10, 11, 13, 15, 17, 19}};
    case 118:
      return IdeasCell{tetra10, {0, 2, 4, 9, 1, 3, 5, 6, 7, 8}};
    default:
      return std::nullopt;
  }
}

/// Plane stress, plane strain, plates, membranes, axisymmetric solids and thin shells number their shapes alike.
std::optional<IdeasCell> face_of(int descriptor) {
  using enum CellType;
  if (descriptor < 41 || descriptor > 96) return std::nullopt;
  switch (descriptor % 10) {
    case 1:
      return IdeasCell{tria3, {}};
    case 2:
      return IdeasCell{tria6, {0, 2, 4, 1, 3, 5}};
    case 4:
      return IdeasCell{quad4, {}};
    case 5:
      return IdeasCell{quad8, {0, 2, 4, 6, 1, 3, 5, 7}};
    default:
      return std::nullopt;
  }
}

std::optional<IdeasCell> cell_of(int descriptor, int nodes) {
  using enum CellType;
  if (descriptor == 161) return IdeasCell{poi1, {}};
  const bool segment =
      is_line(descriptor) || descriptor == 101 || descriptor == 102 || (descriptor >= 136 && descriptor <= 151);
  if (segment && nodes == 1) return IdeasCell{poi1, {}};
  if (segment && nodes == 2) return IdeasCell{seg2, {}};
  if (segment && nodes == 3) return IdeasCell{seg3, {0, 2, 1}};
  const auto face = face_of(descriptor);
  return face ? face : solid_of(descriptor);
}

/// Cells stand type by type, in the order of Code_Aster 17.3.
constexpr std::array type_order = {CellType::seg2,    CellType::tria3,  CellType::tria6,   CellType::quad4,
                                   CellType::quad8,   CellType::tetra4, CellType::tetra10, CellType::penta6,
                                   CellType::penta15, CellType::hexa8,  CellType::hexa20,  CellType::poi1,
                                   CellType::seg3};

class IdeasReader {
 public:
  IdeasReader(std::string_view text, std::string path) : text_(text), path_(std::move(path)) {}

  Mesh read() {
    while (next_line()) {
      if (trimmed() != "-1") continue;
      if (!next_line()) break;
      read_set(to_integer(trimmed(), "the number of a data set"));
    }
    if (mesh_.nodes.empty()) fail("the file holds no nodes (data sets 15, 781 or 2411)");
    finish();
    return std::move(mesh_);
  }

 private:
  void read_set(int number) {
    if (contains(node_sets, number)) {
      read_nodes(number);
    } else if (contains(cell_sets, number)) {
      read_cells(number);
    } else if (contains(pair_group_sets, number)) {
      read_groups(number == 752 ? 6 : 8, 2);
    } else if (contains(quadruple_group_sets, number)) {
      read_groups(8, 4);
    } else {
      while (next_line() && trimmed() != "-1") {
      }
    }
  }

  /// The next line of a data set; false where it ends.
  bool next_record() {
    if (std::exchange(ended_, false)) return false;
    if (!next_line()) fail("a data set does not end with -1");
    return trimmed() != "-1";
  }

  void read_nodes(int set) {
    while (next_record()) {
      const auto head = words();
      const int label = integer_at(head, 0, "the number of a node");
      const std::size_t first = set == 15 ? 4 : 0;
      if (set != 15 && !next_record()) fail("a node has no coordinates");
      const auto values = set == 15 ? head : words();
      if (values.size() < first + 3) fail("three coordinates should stand here");
      Point at;
      for (std::size_t i = 0; i < 3; ++i) at[i] = to_real(values[first + i]);
      if (!node_index_.emplace(label, mesh_.node_count()).second)
        fail(fmt::format("node {} stands twice in the file", label));
      mesh_.nodes.push_back(at);
    }
  }

  void read_cells(int set) {
    while (next_record()) {
      const auto head = words();
      const std::size_t count_place = set == 780 ? 7 : 5;
      const int label = integer_at(head, 0, "the number of an element");
      const int descriptor = integer_at(head, 1, "the kind of an element");
      const int count = integer_at(head, count_place, "the number of nodes of an element");
      if (is_line(descriptor) && !next_record()) fail("an element of a line has no orientation");
      add_cell(label, descriptor, read_numbers(count));
    }
  }

  /// So many numbers, on as many lines as it takes. Some programs write the -1 that ends the data set behind the last
  /// of them.
  std::vector<int> read_numbers(int count) {
    if (count < 0) fail(fmt::format("{} is no number of members", count));
    std::vector<int> numbers;
    while (static_cast<int>(numbers.size()) < count) {
      if (!next_record()) fail("numbers are missing at the end of a data set");
      for (const auto word : words()) numbers.push_back(to_integer(word, "a number"));
    }
    ended_ = static_cast<int>(numbers.size()) == count + 1 && numbers.back() == -1;
    numbers.resize(static_cast<std::size_t>(count));
    return numbers;
  }

  void add_cell(int label, int descriptor, const std::vector<int>& labels) {
    const auto kind = cell_of(descriptor, static_cast<int>(labels.size()));
    if (!kind || node_count(kind->type) != static_cast<int>(labels.size())) {
      fail(fmt::format("element {} of kind {} with {} nodes is not known", label, descriptor, labels.size()),
           "unsupported-cell");
    }
    std::vector<int> nodes;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const int wanted = labels[kind->order.empty() ? i : static_cast<std::size_t>(kind->order[i])];
      const auto found = node_index_.find(wanted);
      if (found == node_index_.end())
        fail(fmt::format("element {} has the node {}, which is not in the file before it", label, wanted));
      nodes.push_back(found->second);
    }
    if (!cell_index_.emplace(label, static_cast<int>(cells_.size())).second)
      fail(fmt::format("element {} stands twice in the file", label));
    const auto rank = std::ranges::find(type_order, kind->type) - type_order.begin();
    cells_.push_back({static_cast<int>(rank), kind->type, std::move(nodes)});
  }

  void read_groups(std::size_t head_size, int stride) {
    while (next_record()) {
      const int count = integer_at(words(), head_size - 1, "the number of members of a group");
      if (!next_record()) fail("a group has no name");
      const std::string name(words().empty() ? std::string_view() : words().front());
      if (count > most_members) fail(fmt::format("a group of {} members does not fit into a file", count));
      const auto numbers = read_numbers(count * stride);
      for (int i = 0; i < count; ++i)
        add_member(name, numbers[static_cast<std::size_t>(i * stride)],
                   numbers[static_cast<std::size_t>(i * stride + 1)]);
    }
  }

  /// Kind 7: a node, 8: an element.
  void add_member(const std::string& name, int kind, int label) {
    if (kind != 7 && kind != 8) return;
    const auto& known = kind == 7 ? node_index_ : cell_index_;
    const auto found = known.find(label);
    if (found == known.end())
      fail(fmt::format("group {} has the {} {}, which is not in the file before it", name,
                       kind == 7 ? "node" : "element", label));
    auto& members = kind == 7 ? mesh_.node_groups[name] : mesh_.cell_groups[name];
    if (in_groups_.insert(fmt::format("{} {} {}", kind, name, found->second)).second) members.push_back(found->second);
  }

  void finish() {
    const std::vector<int> indices = add_by_rank(cells_, mesh_);
    for (auto& [name, members] : mesh_.cell_groups)
      for (int& member : members) member = indices[static_cast<std::size_t>(member)];
    settle_in_plane(mesh_);
  }

  // --- lines

  bool next_line() {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line_ = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    return true;
  }

  std::string_view trimmed() const {
    const auto first = line_.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return line_.substr(first, line_.find_last_not_of(" \t\r") - first + 1);
  }

  std::vector<std::string_view> words() const {
    std::vector<std::string_view> found;
    std::size_t at = 0;
    while ((at = line_.find_first_not_of(" \t\r", at)) != std::string_view::npos) {
      const std::size_t end = std::min(line_.find_first_of(" \t\r", at), line_.size());
      found.push_back(line_.substr(at, end - at));
      at = end;
    }
    return found;
  }

  int integer_at(const std::vector<std::string_view>& found, std::size_t place, const char* what) const {
    if (place >= found.size()) fail(fmt::format("{} should stand here", what));
    return to_integer(found[place], what);
  }

  int to_integer(std::string_view word, const char* what) const {
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      fail(fmt::format("{} should stand here, not {:.20}", what, word));
    return value;
  }

  /// Fortran writes D for the exponent.
  double to_real(std::string_view word) const {
    std::string plain(word);
    std::ranges::replace_if(
        plain, [](char c) { return c == 'D' || c == 'd'; }, 'E');
    double value = 0.0;
    const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    if (error != std::errc() || end != plain.data() + plain.size())
      fail(fmt::format("a coordinate should stand here, not {:.20}", word));
    return value;
  }

  [[noreturn]] void fail(const std::string& what, const char* code = "damaged-mesh") const {
    throw Error(code, fmt::format("{}:{}: {}", path_, number_, what));
  }

  std::string_view text_, line_;
  std::string path_;
  std::size_t at_ = 0;
  int number_ = 0;
  bool ended_ = false;  ///< the data set, on the line read last
  Mesh mesh_;
  std::vector<ListedCell> cells_;
  std::unordered_map<int, int> node_index_, cell_index_;
  std::unordered_set<std::string> in_groups_;
};

}  // namespace

Mesh parse_ideas_mesh(std::string_view text, const std::string& path) { return IdeasReader(text, path).read(); }

Mesh read_ideas_mesh(const std::string& path) { return parse_ideas_mesh(read_text_file(path), path); }

}  // namespace comma::solver
