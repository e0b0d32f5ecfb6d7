#include "solver/mesh/refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/mesh/conversion.hpp"
#include "solver/mesh/new_names.hpp"
#include "solver/mesh/place.hpp"
#include "solver/mesh/reference_element.hpp"

namespace comma::solver {

namespace {

using Corners = std::vector<int>;

/// The middles of these sets of corners are the new nodes, numbered after the corners; each piece names its nodes.
struct Cut {
  std::vector<Corners> middles;
  std::vector<std::vector<int>> pieces;
};

const std::map<CellType, Cut>& cuts() {
  static const std::map<CellType, Cut> table = {
      {CellType::poi1, {{}, {{0}}}},
      {CellType::seg2, {{{0, 1}}, {{0, 2}, {1, 2}}}},
      {CellType::tria3, {{{0, 1}, {1, 2}, {2, 0}}, {{0, 3, 5}, {1, 4, 3}, {2, 5, 4}, {3, 4, 5}}}},
      {CellType::quad4,
       {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}}, {{0, 4, 8, 7}, {1, 5, 8, 4}, {2, 6, 8, 5}, {3, 7, 8, 6}}}},
      {CellType::tetra4,
       {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
        {{0, 4, 6, 7},
         {1, 5, 4, 8},
         {2, 9, 6, 5},
         {3, 7, 9, 8},
         {4, 5, 6, 8},
         {5, 8, 9, 6},
         {7, 8, 4, 6},
         {7, 9, 8, 6}}}},
      {CellType::penta6,
       {{{0, 1},
         {1, 2},
         {2, 0},
         {0, 3},
         {1, 4},
         {2, 5},
         {3, 4},
         {4, 5},
         {5, 3},
         {0, 1, 4, 3},
         {1, 2, 5, 4},
         {2, 0, 3, 5}},
        {{0, 6, 8, 9, 15, 17},
         {6, 1, 7, 15, 10, 16},
         {8, 6, 7, 17, 15, 16},
         {8, 7, 2, 17, 16, 11},
         {9, 15, 17, 3, 12, 14},
         {15, 10, 16, 12, 4, 13},
         {17, 15, 16, 14, 12, 13},
         {17, 16, 11, 14, 13, 5}}}},
      {CellType::hexa8,
       {{{0, 1},
         {1, 2},
         {2, 3},
         {3, 0},
         {0, 4},
         {1, 5},
         {2, 6},
         {3, 7},
         {4, 5},
         {5, 6},
         {6, 7},
         {7, 4},
         {0, 1, 2, 3},
         {0, 1, 5, 4},
         {1, 2, 6, 5},
         {2, 3, 7, 6},
         {3, 0, 4, 7},
         {4, 5, 6, 7},
         {0, 1, 2, 3, 4, 5, 6, 7}},
        {{0, 8, 20, 11, 12, 21, 26, 24},
         {1, 9, 20, 8, 13, 22, 26, 21},
         {2, 10, 20, 9, 14, 23, 26, 22},
         {3, 11, 20, 10, 15, 24, 26, 23},
         {12, 21, 26, 24, 4, 16, 25, 19},
         {13, 22, 26, 21, 5, 17, 25, 16},
         {14, 23, 26, 22, 6, 18, 25, 17},
         {15, 24, 26, 23, 7, 19, 25, 18}}}}};
  return table;
}

const Cut& cut_of(const Mesh& mesh, int cell) {
  const auto found = cuts().find(straight_type(mesh.cell_types[cell]));
  if (found != cuts().end()) return found->second;
  throw Error("unsupported",
              fmt::format("cell {} is a {}, which is not cut into smaller ones", mesh.cell_name(cell),
                          name_of(mesh.cell_types[cell])),
              "cut a mesh without pyramids");
}

/// Where the nodes of the pieces of a cell lie in its reference cell.
std::vector<ReferencePoint> reference_corners(CellType type, const Cut& cut) {
  const auto own = reference_nodes(type).first(static_cast<std::size_t>(corner_count(type)));
  std::vector<ReferencePoint> points(own.begin(), own.end());
  for (const Corners& around : cut.middles) {
    ReferencePoint& middle = points.emplace_back(ReferencePoint{});
    for (const int corner : around)
      for (std::size_t j = 0; j < 3; ++j)
        middle[j] += own[static_cast<std::size_t>(corner)][j] / static_cast<double>(around.size());
  }
  return points;
}

Eigen::Vector3d place_in(const Mesh& mesh, CellType type, std::span<const int> nodes, const ReferencePoint& point) {
  const Eigen::VectorXd values = shape_functions(type, point);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k) sum += values[static_cast<Eigen::Index>(k)] * place(mesh, nodes[k]);
  return sum;
}

/// The nodes of a mesh by the shares that corners of cells have in them (in 192 parts: 4^3 of a hexahedron's piece, and
/// thirds), which are the same seen from each of the cells that have the node in common.
class NodesWithin {
 public:
  explicit NodesWithin(Mesh& mesh) : mesh_(mesh), names_(mesh.node_names, "NS") {}

  using Shares = std::vector<std::pair<int, int>>;
  static Shares shares(CellType type, std::span<const int> nodes, const ReferencePoint& point) {
    constexpr double whole = 192.0;
    const Eigen::VectorXd values = shape_functions(straight_type(type), point);
    Shares result;
    for (int corner = 0; corner < corner_count(type); ++corner)
      if (const auto share = static_cast<int>(std::lround(whole * values[corner])); share != 0)
        result.emplace_back(nodes[static_cast<std::size_t>(corner)], share);
    std::ranges::sort(result);
    return result;
  }

  void know(CellType type, std::span<const int> nodes) {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      known_.try_emplace(shares(type, nodes, reference_nodes(type)[k]), nodes[k]);
  }

  /// `place` is called where the node is new.
  template <class Place>
  int at(Shares shares, Place&& place) {
    const auto [found, is_new] = known_.try_emplace(std::move(shares), mesh_.node_count());
    if (!is_new) return found->second;
    mesh_.nodes.push_back(to_point(place()));
    names_.add();
    return found->second;
  }

  const Mesh& mesh() const { return mesh_; }

 private:
  Mesh& mesh_;
  NewNames names_;
  std::map<Shares, int> known_;
};

std::vector<int> corners_of_pieces(const Mesh& mesh, int cell, NodesWithin& nodes) {
  const CellType type = mesh.cell_types[cell];
  std::vector<int> corners;
  for (const ReferencePoint& point : reference_corners(type, cut_of(mesh, cell)))
    corners.push_back(nodes.at(NodesWithin::shares(type, mesh.cell(cell), point),
                               [&] { return place_in(mesh, type, mesh.cell(cell), point); }));
  return corners;
}

/// A node of a piece beyond its corners, which lie at `corners` of the cell that is cut and are the nodes `own`. Edges
/// and faces of pieces inside a solid are straight, as in Code_Aster 17.3.
int further_node(const Mesh& mesh, int cell, std::span<const ReferencePoint> corners, std::span<const int> own,
                 const ReferencePoint& further, NodesWithin& nodes) {
  const CellType type = mesh.cell_types[cell], linear = straight_type(type);
  const Eigen::VectorXd weights = shape_functions(linear, further);
  ReferencePoint point{};
  constexpr double rounding = 1e-12;  // shape functions are 0 or no less than a sixth at nodes
  int weighing = 0;
  for (std::size_t a = 0; a < corners.size(); ++a) {
    const double weight = weights[static_cast<Eigen::Index>(a)];
    weighing += std::abs(weight) > rounding ? 1 : 0;
    for (std::size_t j = 0; j < 3; ++j) point[j] += weight * corners[a][j];
  }
  const auto shares = NodesWithin::shares(type, mesh.cell(cell), point);
  const bool is_inside = dimension(type) == 3 && static_cast<int>(shares.size()) == corner_count(type);
  const bool is_centre = weighing == corner_count(type);
  return nodes.at(shares, [&] {
    return is_inside && !is_centre ? place_in(nodes.mesh(), linear, own, further)
                                   : place_in(mesh, type, mesh.cell(cell), point);
  });
}

/// The nodes of each piece of a cell, from those at the corners of all of them.
std::vector<std::vector<int>> pieces_of(const Mesh& mesh, int cell, std::span<const int> corners, NodesWithin& nodes) {
  std::vector<std::vector<int>> pieces;
  const Cut& cut = cut_of(mesh, cell);
  const auto all_points = reference_corners(mesh.cell_types[cell], cut);
  for (const std::vector<int>& local : cut.pieces) {
    std::vector<int> own;
    std::vector<ReferencePoint> points;
    for (const int corner : local) {
      own.push_back(corners[static_cast<std::size_t>(corner)]);
      points.push_back(all_points[static_cast<std::size_t>(corner)]);
    }
    const std::vector<int> ends = own;
    for (const ReferencePoint& further : reference_nodes(mesh.cell_types[cell]).subspan(local.size()))
      own.push_back(further_node(mesh, cell, points, ends, further, nodes));
    pieces.push_back(std::move(own));
  }
  return pieces;
}

void name_pieces_of(Mesh& result, const Mesh& mesh, const std::vector<std::vector<int>>& pieces) {
  if (mesh.cell_names.empty()) return;
  result.cell_names.clear();
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::size_t k = 0; k < pieces[static_cast<std::size_t>(cell)].size(); ++k)
      result.cell_names.push_back(fmt::format("{}_{}", mesh.cell_name(cell), k + 1));
}

std::vector<int> lines_first(const Mesh& mesh) {
  std::vector<int> cells(static_cast<std::size_t>(mesh.cell_count()));
  std::iota(cells.begin(), cells.end(), 0);
  std::ranges::stable_partition(cells, [&](int cell) { return dimension(mesh.cell_types[cell]) <= 1; });
  return cells;
}

}  // namespace

Mesh refined(const Mesh& mesh) {
  Mesh result = mesh;
  result.cell_types.clear();
  result.cell_starts = {0};
  result.connectivity.clear();
  result.slave_patches.clear();
  NodesWithin within_cells(result);
  for (int cell = 0; cell < mesh.cell_count(); ++cell) within_cells.know(mesh.cell_types[cell], mesh.cell(cell));
  const auto all = static_cast<std::size_t>(mesh.cell_count());
  std::vector<std::vector<int>> corners(all), pieces(all);
  std::vector<std::vector<std::vector<int>>> nodes_of_pieces(all);
  const std::vector<int> order = lines_first(mesh);
  for (const int cell : order) corners[static_cast<std::size_t>(cell)] = corners_of_pieces(mesh, cell, within_cells);
  for (const int cell : order)
    nodes_of_pieces[static_cast<std::size_t>(cell)] =
        pieces_of(mesh, cell, corners[static_cast<std::size_t>(cell)], within_cells);
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    for (const std::vector<int>& own : nodes_of_pieces[static_cast<std::size_t>(cell)])
      pieces[static_cast<std::size_t>(cell)].push_back(result.add_cell(mesh.cell_types[cell], own));
  name_pieces_of(result, mesh, pieces);
  for (auto& [name, members] : result.cell_groups) {
    std::vector<int> smaller;
    for (const int member : members) {
      const auto& own = pieces[static_cast<std::size_t>(member)];
      smaller.insert(smaller.end(), own.begin(), own.end());
    }
    members = std::move(smaller);
  }
  return result;
}

}  // namespace comma::solver
