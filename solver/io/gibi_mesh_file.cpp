// The file is a row of records. Records of type 2 hold one pile of objects each: pile 1 the meshes, pile 32 the points
// and their places in pile 33, which holds the coordinates. Objects are numbered in their pile; some have names.
#include "solver/io/gibi_mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "solver/error.hpp"
#include "solver/io/text_scanner.hpp"
#include "solver/mesh/flatness.hpp"

namespace comma::solver {
namespace {

using enum CellType;

constexpr int largest_gibi_number = std::numeric_limits<int>::max();

/// Cast3M's number of a cell type, and where the nodes stand in its list that Code_Aster lists one after the other:
/// Cast3M goes round each level, mid-edge nodes between the corners. Empty where the two agree.
struct GibiType {
  int number;
  CellType type;
  std::vector<int> order = {};
};

const std::vector<GibiType>& gibi_types() {
  static const std::vector<GibiType> table = {
      {1, poi1},
      {2, seg2},
      {3, seg3, {0, 2, 1}},
      {4, tria3},
      {6, tria6, {0, 2, 4, 1, 3, 5}},
      {7, tria7, {0, 2, 4, 1, 3, 5, 6}},
      {8, quad4},
      {10, quad8, {0, 2, 4, 6, 1, 3, 5, 7}},
      {11, quad9, {0, 2, 4, 6, 1, 3, 5, 7, 8}},
      {14, hexa8},
      {15, hexa20, {0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 8, 9, 10, 11, 13, 15, 17, 19}},
      {16, penta6},
      {17, penta15, {0, 2, 4, 9, 11, 13, 1, 3, 5, 6, 7, 8, 10, 12, 14}},
      {23, tetra4},
      {24, tetra10, {0, 2, 4, 9, 1, 3, 5, 6, 7, 8}},
      {33, hexa27, {0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 8, 9, 10, 11, 13, 15, 17, 19, 24, 20, 21, 22, 23, 25, 26}},
      {25, pyram5},
      {26, pyram13, {0, 2, 4, 6, 12, 1, 3, 5, 7, 8, 9, 10, 11}}};
  return table;
}

/// One object of pile 1: cells of one type, or other objects.
struct GibiObject {
  std::vector<int> parts;  ///< objects it consists of, from 1
  CellType type = poi1;
  std::vector<std::vector<int>> cells;  ///< points of each cell, from 1
  std::vector<int> indices;             ///< of the cells in the mesh
};

struct NamedObject {
  std::string name;
  int object;  ///< from 1
};

class GibiReader {
 public:
  GibiReader(std::string_view text, const std::string& path) : scan_(text, path) {}

  Mesh read() {
    bool ended = false;
    while (!ended && scan_.skip_to("ENREGISTREMENT")) {
      expect("DE");
      expect("TYPE");
      const int type = scan_.integer("the type of a record");
      if (type == 4) read_dimension();
      if (type == 2) read_pile();
      ended = type == 5;
    }
    if (!ended) scan_.fail("the file is cut off: its last record, of type 5, is missing");
    assemble();
    return std::move(mesh_);
  }

 private:
  void expect(std::string_view wanted) {
    const std::string_view found = scan_.word(wanted);
    if (found != wanted) scan_.fail(fmt::format("{} should stand here, not {:.20}", wanted, found));
  }

  void read_dimension() {
    while (scan_.word("DIMENSION") != "DIMENSION") continue;
    dimension_ = scan_.integer("the dimension", 2, 3);
  }

  /// Words of this line run into its numbers: "PILE NUMERO   1NBRE OBJETS NOMMES       9NBRE OBJETS      23".
  void read_pile() {
    expect("PILE");
    expect("NUMERO");
    const std::string_view line = scan_.rest_of_line();
    const int pile = number_after(line, "");
    const int named = number_after(line, "NOMMES");
    const int objects = number_after(line, "NBRE OBJETS ", true);
    if (pile == 1) read_meshes(named, objects);
    if (pile == 32) read_points(named);
    if (pile == 33) read_coordinates(named);
  }

  /// The number that follows the first (or the last) place of a text.
  int number_after(std::string_view line, std::string_view text, bool last = false) const {
    std::size_t at = last ? line.rfind(text) : line.find(text);
    if (at == std::string_view::npos) scan_.fail(fmt::format("{} should stand in this line", text));
    at = line.find_first_not_of(' ', at + text.size());
    int value = 0;
    const char* begin = line.data() + std::min(at, line.size());
    const auto [end, error] = std::from_chars(begin, line.data() + line.size(), value);
    if (error != std::errc{} || value < 0)
      scan_.fail("this line should say the number of a pile and how many objects it holds");
    return value;
  }

  std::vector<NamedObject> read_names(int count) {
    std::vector<NamedObject> names;
    for (int i = 0; i < count; ++i) names.push_back({std::string(scan_.word("the name of an object")), 0});
    for (NamedObject& named : names)
      named.object = scan_.integer("the number of a named object", 1, largest_gibi_number);
    return names;
  }

  void read_meshes(int named, int count) {
    mesh_names_ = read_names(named);
    for (int i = 0; i < count; ++i) objects_.push_back(read_mesh(count));
  }

  GibiObject read_mesh(int objects) {
    const int number = scan_.integer("the type of cells", 0, largest_gibi_number);
    const int parts = scan_.integer("a number of parts", 0, largest_gibi_number);
    const int references = scan_.integer("a number of references", 0, largest_gibi_number);
    const int nodes = scan_.integer("a number of nodes", 0, largest_gibi_number);
    const int cells = scan_.integer("a number of cells", 0, largest_gibi_number);
    GibiObject object;
    for (int i = 0; i < parts; ++i) object.parts.push_back(scan_.integer("a part of a mesh", 1, objects));
    for (int i = 0; i < references; ++i) scan_.integer("a reference");
    if (parts > 0) return object;
    const GibiType& type = type_of(number, nodes);
    object.type = type.type;
    for (int i = 0; i < cells; ++i) scan_.integer("a colour");
    for (int i = 0; i < cells; ++i) object.cells.push_back(read_cell(type));
    return object;
  }

  const GibiType& type_of(int number, int nodes) const {
    const auto& table = gibi_types();
    const auto found = std::ranges::find(table, number, &GibiType::number);
    if (found == table.end())
      scan_.fail(fmt::format("cells of Cast3M's type {} are not known", number), "unsupported-cell");
    if (node_count(found->type) != nodes) {
      scan_.fail(fmt::format("a {} has {} nodes, not {}", name_of(found->type), node_count(found->type), nodes));
    }
    return *found;
  }

  std::vector<int> read_cell(const GibiType& type) {
    std::vector<int> nodes;
    for (int i = 0; i < node_count(type.type); ++i)
      nodes.push_back(scan_.integer("a point of a cell", 1, largest_gibi_number));
    std::vector<int> ordered = nodes;
    for (std::size_t i = 0; i < type.order.size(); ++i) ordered[i] = nodes[static_cast<std::size_t>(type.order[i])];
    return ordered;
  }

  void read_points(int named) {
    point_names_ = read_names(named);
    const int count = scan_.integer("the number of points", 0, largest_gibi_number);
    for (int i = 0; i < count; ++i) places_.push_back(scan_.integer("the place of a point", 1, largest_gibi_number));
  }

  void read_coordinates(int named) {
    read_names(named);
    const int count = scan_.integer("the number of coordinates", 0, largest_gibi_number);
    for (int i = 0; i < count; ++i) coordinates_.push_back(scan_.real("a coordinate"));
  }

  /// A place holds the coordinates and the density asked for there, which is no matter any more. Nodes are numbered as
  /// the places are, not as the points: so they are in Code_Aster 17.3.
  void assemble() {
    if (places_.empty() || coordinates_.empty()) scan_.fail("the file holds no points");
    mesh_.dimension = dimension_;
    used_places_ = places_;
    std::ranges::sort(used_places_);
    used_places_.erase(std::ranges::unique(used_places_).begin(), used_places_.end());
    const auto stride = static_cast<std::size_t>(dimension_) + 1;
    for (const int place : used_places_) {
      const std::size_t start = (static_cast<std::size_t>(place) - 1) * stride;
      if (start + stride > coordinates_.size())
        scan_.fail(fmt::format("the coordinates of place {}, where a point lies, are missing", place));
      Point point{};
      std::copy_n(coordinates_.begin() + static_cast<std::ptrdiff_t>(start), dimension_, point.begin());
      mesh_.nodes.push_back(point);
    }
    std::vector<bool> needed(objects_.size(), false);
    for (const NamedObject& named : mesh_names_) {
      for (const int number : elementary(named.object)) needed[static_cast<std::size_t>(number) - 1] = true;
    }
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (needed[i]) add_cells(objects_[i]);
    }
    for (const NamedObject& named : mesh_names_) add_group(named);
    for (const NamedObject& named : point_names_) mesh_.node_groups[named.name] = {node_of(named.object)};
    settle_in_plane(mesh_);
  }

  int node_of(int point) const {
    if (static_cast<std::size_t>(point) > places_.size())
      scan_.fail(fmt::format("the mesh has no point {}: it has {}", point, places_.size()));
    const int place = places_[static_cast<std::size_t>(point) - 1];
    return static_cast<int>(std::ranges::lower_bound(used_places_, place) - used_places_.begin());
  }

  /// Objects that no name leads to (the edges of faces, say) make no cells, and a cell that several objects hold, its
  /// nodes in the same order, is one cell.
  void add_cells(GibiObject& object) {
    for (std::vector<int>& cell : object.cells) {
      for (int& point : cell) point = node_of(point);
      std::vector<int> key = cell;
      key.push_back(static_cast<int>(object.type));
      const auto [known, is_new] = cell_index_.try_emplace(std::move(key), mesh_.cell_count());
      if (is_new) mesh_.add_cell(object.type, cell);
      object.indices.push_back(known->second);
    }
  }

  static void keep_first(std::vector<int>& members) {
    std::set<int> passed;
    std::erase_if(members, [&](int member) { return !passed.insert(member).second; });
  }

  void add_group(const NamedObject& named) {
    std::vector<int> cells;
    for (const int number : elementary(named.object)) {
      const GibiObject& object = objects_[static_cast<std::size_t>(number) - 1];
      cells.insert(cells.end(), object.indices.begin(), object.indices.end());
    }
    keep_first(cells);
    if (!cells.empty()) mesh_.cell_groups[named.name] = std::move(cells);
  }

  /// The objects of cells that an object consists of, each once, in its order.
  std::vector<int> elementary(int number) const {
    std::vector<int> found;
    std::set<int> passed;
    std::vector<int> open = {number};
    while (!open.empty()) {
      const int next = open.back();
      open.pop_back();
      if (next > static_cast<int>(objects_.size())) scan_.fail(fmt::format("there is no object {} in the file", next));
      if (!passed.insert(next).second) continue;
      const GibiObject& object = objects_[static_cast<std::size_t>(next) - 1];
      if (object.parts.empty()) found.push_back(next);
      open.insert(open.end(), object.parts.rbegin(), object.parts.rend());
    }
    return found;
  }

  TextScanner scan_;
  int dimension_ = 3;
  std::vector<GibiObject> objects_;
  std::vector<NamedObject> mesh_names_;
  std::vector<NamedObject> point_names_;
  std::vector<int> places_;       ///< of the points, from 1
  std::vector<int> used_places_;  ///< rising: one a node
  std::vector<double> coordinates_;
  std::map<std::vector<int>, int> cell_index_;  ///< by nodes and type
  Mesh mesh_;
};

}  // namespace

Mesh parse_gibi_mesh(std::string_view text, const std::string& path) { return GibiReader(text, path).read(); }

Mesh read_gibi_mesh(const std::string& path) { return parse_gibi_mesh(read_text_file(path), path); }

}  // namespace comma::solver
