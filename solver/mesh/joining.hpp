// Two meshes put together into one (ASSE_MAILLAGE, U4.23.03).
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

struct JoinedMesh {
  Mesh mesh;
  /// Groups of the second mesh whose names the first has too, with their new names: the next free one of NAME_2, NAME_3
  /// ...
  std::vector<std::pair<std::string, std::string>> renamed;
};

/// All nodes, cells and groups of both, the first mesh's before the second's; nothing is shared. Nodes and cells have
/// no names of their own any more.
JoinedMesh superposed(const Mesh& first, const Mesh& second);

/// The same, glued where cells of the first and of the second mesh cover each other: the first's cells go and the
/// second's stay (Code_Aster 17.3), and the nodes of the first's stand for those of the second's that lie within
/// `gluing_tolerance` of the shortest distance between two nodes of a cell; the latter stay as nodes without cells.
/// Throws Error `not-coincident` naming a node that has no partner.
JoinedMesh glued(const Mesh& first, const Mesh& second, std::span<const int> first_cells,
                 std::span<const int> second_cells);

inline constexpr double gluing_tolerance = 1e-3;

}  // namespace comma::solver
