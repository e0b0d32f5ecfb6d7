#include "solver/mesh/part_of.hpp"

#include <deque>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

using CellKey = std::pair<CellType, std::vector<Point>>;

CellKey key_of(const Mesh& mesh, int cell) {
  CellKey key{mesh.cell_types[cell], {}};
  for (const int node : mesh.cell(cell)) key.second.push_back(mesh.nodes[node]);
  return key;
}

}  // namespace

PartOfMesh part_of(const Mesh& whole, const Mesh& part) {
  std::map<CellKey, std::deque<int>> cells_at;
  for (int cell = 0; cell < whole.cell_count(); ++cell) cells_at[key_of(whole, cell)].push_back(cell);
  PartOfMesh result{std::vector<int>(part.nodes.size(), -1), {}};
  for (int cell = 0; cell < part.cell_count(); ++cell) {
    auto& left = cells_at[key_of(part, cell)];
    if (left.empty())
      throw Error("not-a-part", fmt::format("cell {} is none of the mesh of the result", part.cell_name(cell)),
                  "make the mesh by CREA_MAILLAGE, RESTREINT");
    const int own = left.front();
    left.pop_front();
    result.cells.push_back(own);
    for (std::size_t a = 0; a < part.cell(cell).size(); ++a)
      result.nodes[static_cast<std::size_t>(part.cell(cell)[a])] = whole.cell(own)[a];
  }
  std::map<Point, int> node_at;
  for (int node = whole.node_count() - 1; node >= 0; --node) node_at[whole.nodes[node]] = node;
  for (int node = 0; node < part.node_count(); ++node) {
    int& own = result.nodes[static_cast<std::size_t>(node)];
    if (own >= 0) continue;
    const auto found = node_at.find(part.nodes[node]);
    if (found == node_at.end())
      throw Error("not-a-part", fmt::format("node {} is none of the mesh of the result", part.node_name(node)),
                  "make the mesh by CREA_MAILLAGE, RESTREINT");
    own = found->second;
  }
  return result;
}

}  // namespace comma::solver
