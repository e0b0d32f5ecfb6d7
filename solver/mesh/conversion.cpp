#include "solver/mesh/conversion.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>

#include "solver/error.hpp"
#include "solver/mesh/new_names.hpp"
#include "solver/mesh/reference_cell.hpp"

namespace comma::solver {
namespace {

using enum CellType;

CellType quadratic(CellType type) {
  switch (type) {
    case seg2:
      return seg3;
    case tria3:
      return tria6;
    case quad4:
      return quad8;
    case tetra4:
      return tetra10;
    case pyram5:
      return pyram13;
    case penta6:
      return penta15;
    case hexa8:
      return hexa20;
    default:
      return type;
  }
}

CellType target_of(CellType type, Conversion conversion) {
  switch (conversion) {
    case Conversion::to_quadratic:
      return quadratic(type);
    case Conversion::to_linear:
      return straight_type(type);
    case Conversion::hexa20_to_27:
      return type == hexa20 ? hexa27 : type == quad8 ? quad9 : type;
    case Conversion::penta15_to_18:
      return type == penta15 ? penta18 : type == quad8 ? quad9 : type;
    case Conversion::quad8_to_9:
      return type == quad8 ? quad9 : type;
    case Conversion::tria6_to_7:
      return type == tria6 ? tria7 : type;
  }
  return type;
}

using Triangle = std::array<std::size_t, 3>;

/// The triangles of a quadrangle, by its own nodes; none of another cell.
std::span<const Triangle> triangles_in(CellType type) {
  static constexpr std::array<Triangle, 2> of_quad4 = {{{0, 1, 2}, {0, 2, 3}}};
  static constexpr std::array<Triangle, 6> of_quad8 = {
      {{0, 4, 7}, {4, 1, 5}, {5, 2, 6}, {6, 3, 7}, {4, 6, 7}, {4, 5, 6}}};
  static constexpr std::array<Triangle, 8> of_quad9 = {
      {{0, 4, 8}, {4, 1, 8}, {1, 5, 8}, {5, 2, 8}, {2, 6, 8}, {6, 3, 8}, {3, 7, 8}, {7, 0, 8}}};
  switch (type) {
    case quad4:
      return of_quad4;
    case quad8:
      return of_quad8;
    case quad9:
      return of_quad9;
    default:
      return {};
  }
}

/// A node between others, known by the corners that it lies between, in rising order.
struct MiddleNode {
  std::vector<int> corners;
  Eigen::Vector3d place;
};

/// The nodes that the larger type of a cell has and the smaller one lacks.
class QuadraticExtension {
 public:
  QuadraticExtension(const Mesh& mesh, int cell, CellType to)
      : mesh_(mesh), from_(mesh.cell_types[cell]), to_(to), nodes_(mesh.cell(cell)) {}

  std::vector<MiddleNode> middles() const {
    std::vector<MiddleNode> result;
    const bool has_edges = node_count(from_) > corner_count(from_);
    if (!has_edges) {
      for (const auto& edge : middle_edges(to_)) result.push_back({corners(edge), mean(edge)});
      return result;
    }
    for (const auto& face : middle_faces(to_)) result.push_back({corners(face), face_centre(face)});
    static constexpr std::array<int, 3> triangle = {0, 1, 2};
    static constexpr std::array<int, 8> solid = {0, 1, 2, 3, 4, 5, 6, 7};
    if (to_ == tria7) result.push_back({corners(triangle), face_centre(triangle)});
    if (to_ == hexa27) result.push_back({corners(solid), solid_centre()});
    return result;
  }

 private:
  Eigen::Vector3d place(int local) const {
    return Eigen::Vector3d(mesh_.nodes[nodes_[static_cast<std::size_t>(local)]].data());
  }

  std::vector<int> corners(std::span<const int> local) const {
    std::vector<int> result;
    for (const int i : local) result.push_back(nodes_[static_cast<std::size_t>(i)]);
    std::ranges::sort(result);
    return result;
  }

  Eigen::Vector3d mean(std::span<const int> local) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int i : local) sum += place(i);
    return sum / static_cast<double>(local.size());
  }

  /// The eight-node quadrangle at its centre: each corner counts -1/4, each mid-edge node 1/2; the six-node triangle:
  /// -1/9 and 4/9.
  Eigen::Vector3d face_centre(std::span<const int> face) const {
    const bool triangle = face.size() == 3;
    Eigen::Vector3d sum = (triangle ? -1.0 / 3.0 : -1.0) * mean(face);
    const auto edges = middle_edges(from_);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const bool on_face =
          std::ranges::all_of(edges[i], [&](int corner) { return std::ranges::find(face, corner) != face.end(); });
      if (on_face) sum += (triangle ? 4.0 / 9.0 : 0.5) * place(corner_count(from_) + static_cast<int>(i));
    }
    return sum;
  }

  /// The twenty-node hexahedron at its centre: each corner counts -1/4, each mid-edge node 1/4.
  Eigen::Vector3d solid_centre() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < 20; ++i) sum += (i < 8 ? -0.25 : 0.25) * place(i);
    return sum;
  }

  const Mesh& mesh_;
  CellType from_;
  CellType to_;
  std::span<const int> nodes_;
};

/// Nodes between others, made once for all cells that share them.
class MiddleNodes {
 public:
  explicit MiddleNodes(Mesh& mesh) : mesh_(mesh), names_(mesh.node_names, "NS") {}

  void want(const std::vector<MiddleNode>& middles) {
    for (const MiddleNode& middle : middles) known_.emplace(middle.corners, -1);
  }

  /// Makes those that are wanted and not made yet.
  void make(const std::vector<MiddleNode>& middles) {
    for (const MiddleNode& middle : middles) {
      const auto found = known_.find(middle.corners);
      if (found == known_.end() || found->second >= 0) continue;
      found->second = mesh_.node_count();
      mesh_.nodes.push_back({middle.place[0], middle.place[1], middle.place[2]});
      names_.add();
    }
  }

  int at(const MiddleNode& middle) const { return known_.at(middle.corners); }

 private:
  Mesh& mesh_;
  NewNames names_;
  std::map<std::vector<int>, int> known_;
};

std::vector<std::vector<int>> nodes_of_cells(const Mesh& mesh) {
  std::vector<std::vector<int>> nodes;
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    nodes.emplace_back(mesh.cell(cell).begin(), mesh.cell(cell).end());
  return nodes;
}

/// Puts cells of other types, on other nodes, in the place of those of a mesh.
void replace_cells(Mesh& mesh, const std::vector<CellType>& types, const std::vector<std::vector<int>>& nodes) {
  mesh.cell_types.clear();
  mesh.connectivity.clear();
  mesh.cell_starts = {0};
  for (std::size_t cell = 0; cell < types.size(); ++cell) mesh.add_cell(types[cell], nodes[cell]);
}

void renumber(Groups& groups, const std::vector<int>& new_index) {
  for (auto group = groups.begin(); group != groups.end();) {
    std::vector<int> kept;
    for (const int member : group->second) {
      if (new_index[static_cast<std::size_t>(member)] >= 0) kept.push_back(new_index[static_cast<std::size_t>(member)]);
    }
    if (kept.empty()) {
      group = groups.erase(group);
    } else {
      (group++)->second = std::move(kept);
    }
  }
}

/// Patches that lose a face go.
void renumber_patches(Mesh& mesh, const std::vector<int>& new_index) {
  std::erase_if(mesh.slave_patches, [&](const std::vector<int>& faces) {
    return std::ranges::any_of(faces, [&](int face) { return new_index[static_cast<std::size_t>(face)] < 0; });
  });
  for (auto& faces : mesh.slave_patches)
    for (int& face : faces) face = new_index[static_cast<std::size_t>(face)];
}

/// Keeps the nodes that cells use.
void drop_loose_nodes(Mesh& mesh, const std::vector<bool>& candidates) {
  std::vector<bool> used(mesh.nodes.size(), false);
  for (const int node : mesh.connectivity) used[static_cast<std::size_t>(node)] = true;
  std::vector<int> new_index(mesh.nodes.size(), -1);
  std::vector<Point> nodes;
  std::vector<std::string> names;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (candidates[node] && !used[node]) continue;
    new_index[node] = static_cast<int>(nodes.size());
    nodes.push_back(mesh.nodes[node]);
    names.push_back(mesh.node_name(static_cast<int>(node)));
  }
  if (nodes.size() == mesh.nodes.size()) return;
  mesh.nodes = std::move(nodes);
  mesh.node_names = std::move(names);
  for (int& node : mesh.connectivity) node = new_index[static_cast<std::size_t>(node)];
  renumber(mesh.node_groups, new_index);
}

/// Names for the pieces of the cells of another mesh: the first has that of the whole, the others have new ones.
void name_pieces(Mesh& mesh, const Mesh& whole, const std::vector<std::vector<int>>& pieces) {
  if (whole.cell_names.empty()) return;
  NewNames names(mesh.cell_names, "M");
  std::vector<std::string> all;
  for (std::size_t cell = 0; cell < pieces.size(); ++cell) {
    all.push_back(whole.cell_names[cell]);
    for (std::size_t i = 1; i < pieces[cell].size(); ++i) {
      names.add();
      all.push_back(mesh.cell_names.back());
    }
  }
  mesh.cell_names = std::move(all);
}

/// Numbers nodes in the order in which cells meet them, those that no cell has last.
void renumber_nodes(Mesh& mesh) {
  std::vector<int> order;
  std::vector<int> new_index(mesh.nodes.size(), -1);
  const auto meet = [&](int node) {
    if (new_index[static_cast<std::size_t>(node)] >= 0) return;
    new_index[static_cast<std::size_t>(node)] = static_cast<int>(order.size());
    order.push_back(node);
  };
  for (const int node : mesh.connectivity) meet(node);
  for (int node = 0; node < mesh.node_count(); ++node) meet(node);
  std::vector<Point> nodes;
  std::vector<std::string> names;
  for (const int node : order) {
    nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
    names.push_back(mesh.node_name(node));
  }
  mesh.nodes = std::move(nodes);
  mesh.node_names = std::move(names);
  for (int& node : mesh.connectivity) node = new_index[static_cast<std::size_t>(node)];
  renumber(mesh.node_groups, new_index);
}

void add_group(Mesh& mesh, const std::string& name, std::vector<int> cells) {
  if (mesh.cell_groups.try_emplace(name, std::move(cells)).second) return;
  throw Error("group-exists", fmt::format("the mesh has a cell group {} already", name), "choose another name");
}

/// Lines before faces before solids: the order in which Code_Aster numbers the nodes that cells get, of all cells of
/// the mesh, the ones that stay as they are too.
std::vector<int> by_dimension(const Mesh& mesh) {
  std::vector<int> result(static_cast<std::size_t>(mesh.cell_count()));
  std::iota(result.begin(), result.end(), 0);
  std::ranges::stable_sort(result, {}, [&](int cell) { return dimension(mesh.cell_types[cell]); });
  return result;
}

}  // namespace

CellType straight_type(CellType type) {
  switch (type) {
    case seg3:
    case seg4:
      return seg2;
    case tria6:
    case tria7:
      return tria3;
    case quad8:
    case quad9:
      return quad4;
    case tetra10:
      return tetra4;
    case pyram13:
      return pyram5;
    case penta15:
    case penta18:
      return penta6;
    case hexa20:
    case hexa27:
      return hexa8;
    default:
      return type;
  }
}

Mesh converted(const Mesh& mesh, std::span<const int> cells, Conversion conversion) {
  Mesh result = mesh;
  MiddleNodes made(result);
  std::vector<CellType> types = mesh.cell_types;
  const auto middles = [&](int cell) {
    const CellType to = target_of(mesh.cell_types[cell], conversion);
    if (node_count(to) <= node_count(mesh.cell_types[cell])) return std::vector<MiddleNode>();
    return QuadraticExtension(mesh, cell, to).middles();
  };
  for (const int cell : cells) {
    types[cell] = target_of(mesh.cell_types[cell], conversion);
    made.want(middles(cell));
  }
  for (const int cell : by_dimension(mesh)) made.make(middles(cell));
  std::vector<std::vector<int>> nodes = nodes_of_cells(mesh);
  std::vector<bool> left(mesh.nodes.size(), false);
  for (const int cell : cells) {
    for (const MiddleNode& middle : middles(cell)) nodes[cell].push_back(made.at(middle));
    if (node_count(types[cell]) >= node_count(mesh.cell_types[cell])) continue;
    for (const int node : nodes[cell]) left[static_cast<std::size_t>(node)] = true;
    nodes[cell].resize(static_cast<std::size_t>(node_count(types[cell])));
  }
  replace_cells(result, types, nodes);
  left.resize(result.nodes.size(), false);
  drop_loose_nodes(result, left);
  return result;
}

Mesh with_triangles(const Mesh& mesh, std::span<const int> cells) {
  Mesh result = mesh;
  const std::set<int> chosen(cells.begin(), cells.end());
  std::vector<CellType> types;
  std::vector<std::vector<int>> nodes;
  std::vector<std::vector<int>> pieces(static_cast<std::size_t>(mesh.cell_count()));  // of each cell
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto whole = mesh.cell(cell);
    const auto triangles = chosen.contains(cell) ? triangles_in(mesh.cell_types[cell]) : std::span<const Triangle>();
    const auto add = [&](CellType type, std::vector<int> own) {
      pieces[static_cast<std::size_t>(cell)].push_back(static_cast<int>(types.size()));
      types.push_back(type);
      nodes.push_back(std::move(own));
    };
    for (const Triangle& t : triangles) add(tria3, {whole[t[0]], whole[t[1]], whole[t[2]]});
    if (triangles.empty()) add(mesh.cell_types[cell], {whole.begin(), whole.end()});
  }
  replace_cells(result, types, nodes);
  name_pieces(result, mesh, pieces);
  for (auto& [name, members] : result.cell_groups) {
    std::vector<int> all;
    for (const int member : members) {
      const auto& own = pieces[static_cast<std::size_t>(member)];
      all.insert(all.end(), own.begin(), own.end());
    }
    members = std::move(all);
  }
  return result;
}

void double_cells(Mesh& mesh, std::span<const int> cells, const std::string& group) {
  NewNames names(mesh.cell_names, "E");
  std::vector<int> made;
  for (const int cell : cells) {
    const std::vector<int> nodes(mesh.cell(cell).begin(), mesh.cell(cell).end());
    made.push_back(mesh.add_cell(mesh.cell_types[cell], nodes));
    names.add();
  }
  add_group(mesh, group, std::move(made));
}

void add_points(Mesh& mesh, std::span<const int> nodes, const std::string& group) {
  NewNames names(mesh.cell_names, "P");
  std::vector<int> made;
  std::vector<int> rising(nodes.begin(), nodes.end());
  std::ranges::sort(rising);
  for (const int node : rising) {
    made.push_back(mesh.add_cell(poi1, std::array{node}));
    names.add();
  }
  if (!group.empty()) add_group(mesh, group, std::move(made));
}

Mesh restricted(const Mesh& mesh, std::span<const int> cells) {
  Mesh result = mesh;
  std::vector<int> new_index(static_cast<std::size_t>(mesh.cell_count()), -1);
  std::vector<CellType> types;
  std::vector<std::vector<int>> nodes;
  std::vector<std::string> names;
  std::vector<int> rising(cells.begin(), cells.end());
  std::ranges::sort(rising);
  for (const int cell : rising) {
    new_index[static_cast<std::size_t>(cell)] = static_cast<int>(types.size());
    types.push_back(mesh.cell_types[cell]);
    nodes.emplace_back(mesh.cell(cell).begin(), mesh.cell(cell).end());
    names.push_back(mesh.cell_name(cell));
  }
  replace_cells(result, types, nodes);
  result.cell_names = std::move(names);
  renumber(result.cell_groups, new_index);
  renumber_patches(result, new_index);
  drop_loose_nodes(result, std::vector<bool>(mesh.nodes.size(), true));
  renumber_nodes(result);
  return result;
}

}  // namespace comma::solver
