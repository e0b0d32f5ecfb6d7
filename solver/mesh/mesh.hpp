// The mesh: nodes, cells, named groups of both. Plain data with invariants.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/mesh/cell_type.hpp"
#include "solver/mesh/named_groups.hpp"

namespace comma::solver {

using Point = std::array<double, 3>;

/// Invariants: cell_starts has cell_count()+1 entries, rising; connectivity holds node indices in [0, node_count());
/// groups hold valid indices, each once, in the order in which the group was made (an ordered group is a path).
/// Coordinates are in the user's unit of length; z is 0 in a plane mesh.
struct Mesh {
  int dimension = 3;  ///< 2 or 3: the space the coordinates live in
  std::vector<Point> nodes;
  std::vector<CellType> cell_types;
  std::vector<int> cell_starts = {0};
  std::vector<int> connectivity;
  std::vector<std::string> node_names;  ///< empty when nodes have no names of their own; then node i is called "N<i+1>"
  std::vector<std::string> cell_names;  ///< the same with "M<i+1>"
  Groups node_groups;
  Groups cell_groups;
  std::vector<std::vector<int>> slave_patches;  ///< face cells of each patch of a contact surface; see slave_cut.hpp

  int node_count() const { return static_cast<int>(nodes.size()); }
  int cell_count() const { return static_cast<int>(cell_types.size()); }
  std::span<const int> cell(int index) const {
    return {connectivity.data() + cell_starts[index],
            static_cast<std::size_t>(cell_starts[index + 1] - cell_starts[index])};
  }
  std::string node_name(int index) const;
  std::string cell_name(int index) const;
  /// Index of a named node or cell; -1 if there is none. Where they have no names of their own, the bare number does
  /// too: "12" is "M12".
  int find_node(std::string_view name) const;
  int find_cell(std::string_view name) const;

  /// Adds a cell; returns its index.
  int add_cell(CellType type, std::span<const int> cell_nodes);

  /// The group, or Error `unknown-group` with the nearest known name as hint.
  const std::vector<int>& node_group(std::string_view name) const;
  const std::vector<int>& cell_group(std::string_view name) const;

  /// The nodes of the cells, rising, each once.
  std::vector<int> nodes_of_cells(std::span<const int> cells) const;
};

}  // namespace comma::solver
