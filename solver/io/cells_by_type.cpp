#include "solver/io/cells_by_type.hpp"

#include <algorithm>
#include <numeric>

namespace comma::solver {

std::vector<int> add_by_rank(std::span<const ListedCell> cells, Mesh& mesh) {
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t cell) { return cells[cell].rank; });
  std::vector<int> indices(cells.size());
  for (const std::size_t cell : order) indices[cell] = mesh.add_cell(cells[cell].type, cells[cell].nodes);
  return indices;
}

}  // namespace comma::solver
