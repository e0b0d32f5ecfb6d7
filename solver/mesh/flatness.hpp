// Which meshes lie in the plane.
#pragma once

#include <algorithm>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Faces in the plane Z = 0, and no solids, are a mesh of two dimensions, whatever a file says of the space around
/// them: their edges have normals in that plane. Lines alone are left as they are.
inline void settle_in_plane(Mesh& mesh) {
  const auto has = [&](int wanted) {
    return std::ranges::any_of(mesh.cell_types, [&](CellType type) { return dimension(type) == wanted; });
  };
  const auto is_flat = [](const Point& node) { return node[2] == 0.0; };
  if (has(2) && !has(3) && std::ranges::all_of(mesh.nodes, is_flat)) mesh.dimension = 2;
}

}  // namespace comma::solver
