#include "solver/io/gmsh_mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <unordered_map>
#include <vector>

#include "solver/error.hpp"
#include "solver/io/cells_by_type.hpp"
#include "solver/io/gmsh_cells.hpp"
#include "solver/io/text_scanner.hpp"
#include "solver/mesh/flatness.hpp"

namespace comma::solver {
namespace {

constexpr int largest = std::numeric_limits<int>::max();

class GmshReader {
 public:
  GmshReader(std::string_view text, const std::string& path) : scan_(text, path) {}

  Mesh read() {
    while (!scan_.at_end()) {
      const std::string_view section = scan_.word("a section");
      if (section == "$NOD") {
        read_nodes_1();
      } else if (section == "$ELM") {
        read_cells_1();
      } else if (section == "$MeshFormat") {
        read_format();
      } else if (section == "$PhysicalNames") {
        read_names();
      } else if (section == "$Entities") {
        read_entities();
      } else if (section == "$Nodes") {
        version_ < 4.0 ? read_nodes_1() : read_nodes_4();
      } else if (section == "$Elements") {
        version_ < 4.0 ? read_cells_2() : read_cells_4();
      } else if (!section.starts_with('$')) {
        scan_.fail(fmt::format("a section such as $Nodes should begin here, not {:.20}", section));
      } else if (!scan_.skip_to(closing(section))) {
        scan_.fail(fmt::format("the section {} does not end", section));
      }
    }
    finish();
    return std::move(mesh_);
  }

 private:
  static std::string closing(std::string_view section) {
    const bool old = section == "$NOD" || section == "$ELM";
    return (old ? "$END" : "$End") + std::string(section.substr(1));
  }

  void close(std::string_view section) {
    const std::string wanted = closing(section);
    if (scan_.word(wanted) != wanted)
      scan_.fail(fmt::format("{} should stand here: the section is longer than it says", wanted));
  }

  void read_format() {
    version_ = scan_.real("the version");
    const bool known = (version_ >= 2.0 && version_ < 3.0) || (version_ >= 4.0 && version_ < 5.0);
    if (!known)
      scan_.fail(fmt::format("version {} of the format is not known", version_), "unsupported",
                 "save the mesh in version 2.2 or 4.1");
    if (scan_.integer("the kind of file") != 0)
      scan_.fail("this is a binary file", "unsupported", "save the mesh as text (ASCII)");
    scan_.integer("the size of a real");
    close("$MeshFormat");
  }

  void read_names() {
    const int count = scan_.integer("the number of names", 0, largest);
    for (int i = 0; i < count; ++i) {
      const int dimension = scan_.integer("the dimension of a physical group", 0, 3);
      const int number = scan_.integer("the number of a physical group");
      const std::string_view line = scan_.rest_of_line();
      const std::size_t first = line.find('"');
      const std::size_t last = line.rfind('"');
      if (first == last) scan_.fail("the name of a physical group should stand between quotes here");
      names_[{dimension, number}] = line.substr(first + 1, last - first - 1);
    }
    close("$PhysicalNames");
  }

  /// Version 4: which physical groups the points, curves, surfaces and volumes of the geometry belong to.
  void read_entities() {
    std::array<int, 4> counts;
    for (int& count : counts) count = scan_.integer("a number of entities", 0, largest);
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (int i = 0; i < counts[dimension]; ++i) read_entity(dimension);
    }
    close("$Entities");
  }

  void read_entity(int dimension) {
    const int number = scan_.integer("the number of an entity");
    // A point has its coordinates, everything else the corners of its box; before 4.1 a point had a box as well.
    const int coordinates = dimension == 0 && version_ >= 4.1 ? 3 : 6;
    for (int i = 0; i < coordinates; ++i) scan_.real("a coordinate of an entity");
    auto& groups = entity_groups_[{dimension, number}];
    const int count = scan_.integer("a number of physical groups", 0, largest);
    for (int i = 0; i < count; ++i) groups.push_back(std::abs(scan_.integer("the number of a physical group")));
    if (dimension == 0) return;
    const int bounds = scan_.integer("a number of bounding entities", 0, largest);
    for (int i = 0; i < bounds; ++i) scan_.integer("a bounding entity");
  }

  void add_node(int number, const Point& at) {
    if (!node_index_.emplace(number, mesh_.node_count()).second)
      scan_.fail(fmt::format("node {} stands twice in the file", number));
    mesh_.nodes.push_back(at);
  }

  Point read_point() { return {scan_.real("a coordinate"), scan_.real("a coordinate"), scan_.real("a coordinate")}; }

  /// Versions 1 and 2 alike.
  void read_nodes_1() {
    const int count = scan_.integer("the number of nodes", 0, largest);
    for (int i = 0; i < count; ++i) {
      const int number = scan_.integer("the number of a node");
      add_node(number, read_point());
    }
    close(version_ < 2.0 ? "$NOD" : "$Nodes");
  }

  void read_nodes_4() {
    const int blocks = scan_.integer("the number of blocks", 0, largest);
    scan_.integer("the number of nodes", 0, largest);
    if (version_ >= 4.1) {
      scan_.integer("the smallest number");
      scan_.integer("the largest number");
    }
    for (int block = 0; block < blocks; ++block) version_ >= 4.1 ? read_node_block() : read_node_block_40();
    close("$Nodes");
  }

  void read_node_block() {
    scan_.integer("a dimension", 0, 3);
    scan_.integer("the number of an entity");
    if (scan_.integer("whether nodes have parameters", 0, 1) != 0) {
      scan_.fail("nodes with parametric coordinates are not read", "unsupported", "save the mesh without them");
    }
    const int count = scan_.integer("the number of nodes of a block", 0, largest);
    std::vector<int> numbers;
    for (int i = 0; i < count; ++i) numbers.push_back(scan_.integer("the number of a node"));
    for (const int number : numbers) add_node(number, read_point());
  }

  /// Version 4.0: each node with its number.
  void read_node_block_40() {
    scan_.integer("the number of an entity");
    scan_.integer("a dimension", 0, 3);
    if (scan_.integer("whether nodes have parameters", 0, 1) != 0) {
      scan_.fail("nodes with parametric coordinates are not read", "unsupported", "save the mesh without them");
    }
    const int count = scan_.integer("the number of nodes of a block", 0, largest);
    for (int i = 0; i < count; ++i) {
      const int number = scan_.integer("the number of a node");
      add_node(number, read_point());
    }
  }

  const GmshType& type_of(int number) const {
    const auto& table = gmsh_types();
    const auto found = std::ranges::find(table, number, &GmshType::number);
    if (found == table.end()) {
      scan_.fail(fmt::format("cells of Gmsh's type {} are not known", number), "unsupported-cell",
                 "mesh with orders 1 or 2");
    }
    return *found;
  }

  void read_cell(int number, const GmshType& type, const std::vector<int>& groups) {
    const int count = node_count(type.type);
    nodes_.resize(static_cast<std::size_t>(count));
    for (int& node : nodes_) {
      const int name = scan_.integer("the number of a node");
      const auto found = node_index_.find(name);
      if (found == node_index_.end())
        scan_.fail(fmt::format("cell {} has the node {}, which is not in the file", number, name));
      node = found->second;
    }
    std::vector<int> ordered = nodes_;
    for (std::size_t i = 0; i < type.order.size(); ++i) ordered[i] = nodes_[static_cast<std::size_t>(type.order[i])];
    const CellType kept = kept_type(type.type);
    ordered.resize(static_cast<std::size_t>(node_count(kept)));
    cells_.push_back({type.number, kept, std::move(ordered)});
    groups_.push_back(groups);
  }

  void read_cells_1() {
    const int count = scan_.integer("the number of cells", 0, largest);
    for (int i = 0; i < count; ++i) {
      const int number = scan_.integer("the number of a cell");
      const GmshType& type = type_of(scan_.integer("the type of a cell"));
      const int group = scan_.integer("a physical group", 0, largest);
      scan_.integer("an entity");
      if (scan_.integer("a number of nodes") != node_count(type.type)) {
        scan_.fail(fmt::format("cell {} is a {} of {} nodes", number, name_of(type.type), node_count(type.type)));
      }
      read_cell(number, type, {group});
    }
    close("$ELM");
  }

  void read_cells_2() {
    const int count = scan_.integer("the number of cells", 0, largest);
    for (int i = 0; i < count; ++i) {
      const int number = scan_.integer("the number of a cell");
      const GmshType& type = type_of(scan_.integer("the type of a cell"));
      const int tags = scan_.integer("a number of tags", 0, largest);
      std::vector<int> groups;
      for (int tag = 0; tag < tags; ++tag) {
        const int value = scan_.integer("a tag");
        if (tag == 0) groups.push_back(std::abs(value));  // negative: the geometry runs in the other sense
      }
      read_cell(number, type, groups);
    }
    close("$Elements");
  }

  void read_cells_4() {
    const int blocks = scan_.integer("the number of blocks", 0, largest);
    scan_.integer("the number of cells", 0, largest);
    if (version_ >= 4.1) {
      scan_.integer("the smallest number");
      scan_.integer("the largest number");
    }
    for (int block = 0; block < blocks; ++block) {
      const int first = scan_.integer("a dimension or entity");
      const int second = scan_.integer("a dimension or entity");
      const auto [dimension, entity] = version_ >= 4.1 ? std::pair(first, second) : std::pair(second, first);
      const GmshType& type = type_of(scan_.integer("the type of cells"));
      const int count = scan_.integer("the number of cells of a block", 0, largest);
      const auto groups = entity_groups_.find({dimension, entity});
      for (int i = 0; i < count; ++i) {
        const int number = scan_.integer("the number of a cell");
        read_cell(number, type, groups == entity_groups_.end() ? std::vector<int>() : groups->second);
      }
    }
    close("$Elements");
  }

  /// Cells stand type by type, in the order of Gmsh's numbers; groups list them as the file does.
  void add_cells() {
    const std::vector<int> indices = add_by_rank(cells_, mesh_);
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      for (const int group : groups_[cell]) add_to_groups(indices[cell], dimension(cells_[cell].type), group);
    }
  }

  void add_to_groups(int cell, int dimension, int group) {
    const auto add = [&](const std::string& name) {  // once: two physical groups may have one name
      std::vector<int>& members = mesh_.cell_groups[name];
      if (members.empty() || members.back() != cell) members.push_back(cell);
    };
    add(fmt::format("GM{}", group));
    const auto named = names_.find({dimension, group});
    if (named != names_.end()) add(named->second);
  }

  /// Nodes that no cell has are none of the mesh: centres of circles, centres of QUAD9.
  void drop_unused_nodes() {
    std::vector<int> number(mesh_.nodes.size(), 0);
    for (const ListedCell& cell : cells_) {
      for (const int node : cell.nodes) number[static_cast<std::size_t>(node)] = 1;
    }
    int count = 0;
    for (std::size_t node = 0; node < number.size(); ++node) {
      if (number[node] == 0) continue;
      mesh_.nodes[static_cast<std::size_t>(count)] = mesh_.nodes[node];
      number[node] = count++;
    }
    mesh_.nodes.resize(static_cast<std::size_t>(count));
    for (ListedCell& cell : cells_) {
      for (int& node : cell.nodes) node = number[static_cast<std::size_t>(node)];
    }
  }

  void finish() {
    if (mesh_.nodes.empty()) scan_.fail("the file holds no nodes");
    if (cells_.empty()) scan_.fail("the file holds no cells");
    drop_unused_nodes();
    add_cells();
    settle_in_plane(mesh_);
  }

  TextScanner scan_;
  double version_ = 1.0;
  Mesh mesh_;
  std::vector<ListedCell> cells_;         ///< ranked by Gmsh's numbers of types
  std::vector<std::vector<int>> groups_;  ///< physical ones, of each cell
  std::unordered_map<int, int> node_index_;
  std::map<std::pair<int, int>, std::string> names_;               ///< by dimension and number
  std::map<std::pair<int, int>, std::vector<int>> entity_groups_;  ///< by dimension and number
  std::vector<int> nodes_;
};

}  // namespace

Mesh parse_gmsh_mesh(std::string_view text, const std::string& path) { return GmshReader(text, path).read(); }

Mesh read_gmsh_mesh(const std::string& path) { return parse_gmsh_mesh(read_text_file(path), path); }

}  // namespace comma::solver
