#include "solver/mesh/refinement.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/mesh/new_names.hpp"
#include "solver/mesh/place.hpp"

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
  const auto found = cuts().find(mesh.cell_types[cell]);
  if (found != cuts().end()) return found->second;
  throw Error("unsupported",
              fmt::format("cell {} is a {}, which is not cut into smaller ones", mesh.cell_name(cell),
                          name_of(mesh.cell_types[cell])),
              "refine linear cells, and give them their further nodes afterwards (LINE_QUAD)");
}

/// Adds the new nodes, those of lines first; middles of the same corners are one node.
class Middles {
 public:
  explicit Middles(Mesh& mesh) : mesh_(mesh), names_(mesh.node_names, "NS") {}

  /// The corners of a cell and its new nodes, as pieces number them.
  std::vector<int> nodes_of(std::span<const int> corners, const Cut& cut) {
    std::vector<int> nodes(corners.begin(), corners.end());
    for (const Corners& local : cut.middles) {
      Corners around;
      for (const int a : local) around.push_back(corners[static_cast<std::size_t>(a)]);
      nodes.push_back(middle(std::move(around)));
    }
    return nodes;
  }

 private:
  int middle(Corners around) {
    std::ranges::sort(around);
    const auto [found, is_new] = known_.try_emplace(around, mesh_.node_count());
    if (!is_new) return found->second;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int node : around) sum += place(mesh_, node);
    mesh_.nodes.push_back(to_point(sum / static_cast<double>(around.size())));
    names_.add();
    return found->second;
  }

  Mesh& mesh_;
  NewNames names_;
  std::map<Corners, int> known_;
};

void name_pieces_of(Mesh& result, const Mesh& mesh, const std::vector<std::vector<int>>& pieces) {
  if (mesh.cell_names.empty()) return;
  result.cell_names.clear();
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::size_t k = 0; k < pieces[static_cast<std::size_t>(cell)].size(); ++k)
      result.cell_names.push_back(fmt::format("{}_{}", mesh.cell_name(cell), k + 1));
}

}  // namespace

Mesh refined(const Mesh& mesh) {
  Mesh result = mesh;
  result.cell_types.clear();
  result.cell_starts = {0};
  result.connectivity.clear();
  result.slave_patches.clear();
  Middles middles(result);
  const auto all = static_cast<std::size_t>(mesh.cell_count());
  std::vector<std::vector<int>> nodes(all), pieces(all);
  for (const bool of_lines : {true, false})
    for (int cell = 0; cell < mesh.cell_count(); ++cell)
      if ((dimension(mesh.cell_types[cell]) <= 1) == of_lines)
        nodes[static_cast<std::size_t>(cell)] = middles.nodes_of(mesh.cell(cell), cut_of(mesh, cell));
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    for (const std::vector<int>& piece : cut_of(mesh, cell).pieces) {
      std::vector<int> own;
      for (const int local : piece)
        own.push_back(nodes[static_cast<std::size_t>(cell)][static_cast<std::size_t>(local)]);
      pieces[static_cast<std::size_t>(cell)].push_back(result.add_cell(mesh.cell_types[cell], own));
    }
  }
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
