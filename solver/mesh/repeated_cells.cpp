#include "solver/mesh/repeated_cells.hpp"

#include <algorithm>
#include <compare>
#include <span>

namespace comma::solver {
namespace {

/// The nodes of each cell, rising, as the mesh's own connectivity holds them.
class SortedCells {
 public:
  explicit SortedCells(const Mesh& mesh) : mesh_(mesh), nodes_(mesh.connectivity) {
    for (int cell = 0; cell < mesh.cell_count(); ++cell)
      std::sort(nodes_.begin() + mesh.cell_starts[cell], nodes_.begin() + mesh.cell_starts[cell + 1]);
  }

  bool same(int a, int b) const {
    return mesh_.cell_types[a] == mesh_.cell_types[b] && std::ranges::equal(nodes(a), nodes(b));
  }
  bool before(int a, int b) const {
    if (mesh_.cell_types[a] != mesh_.cell_types[b]) return mesh_.cell_types[a] < mesh_.cell_types[b];
    const auto order =
        std::lexicographical_compare_three_way(nodes(a).begin(), nodes(a).end(), nodes(b).begin(), nodes(b).end());
    return order != 0 ? order < 0 : a < b;
  }

 private:
  std::span<const int> nodes(int cell) const {
    return std::span(nodes_).subspan(mesh_.cell_starts[cell], mesh_.cell(cell).size());
  }

  const Mesh& mesh_;
  std::vector<int> nodes_;
};

}  // namespace

std::vector<RepeatedCell> repeated_cells(const Mesh& mesh) {
  const SortedCells sorted(mesh);
  std::vector<int> order;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (mesh.cell_types[cell] != CellType::poi1) order.push_back(cell);
  }
  std::ranges::sort(order, [&](int a, int b) { return sorted.before(a, b); });
  std::vector<RepeatedCell> result;
  for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
    if (sorted.same(order[first], order[i])) {
      result.push_back({order[first], order[i]});
    } else {
      first = i;
    }
  }
  std::ranges::sort(result, {}, &RepeatedCell::again);
  return result;
}

std::vector<int> collapsed_cells(const Mesh& mesh) {
  std::vector<int> collapsed;
  std::vector<int> nodes;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    nodes.assign(mesh.cell(cell).begin(), mesh.cell(cell).end());
    std::ranges::sort(nodes);
    if (std::ranges::adjacent_find(nodes) != nodes.end()) collapsed.push_back(cell);
  }
  return collapsed;
}

}  // namespace comma::solver
