// Moments spread over plates and along their edges (U4.44.01, FORCE_COQUE and FORCE_ARETE).
#pragma once

#include <array>
#include <vector>

#include "solver/loads/load.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// A moment per area on a plate, or per length on an edge, about the axes of the mesh.
struct PlateMoment {
  int cell;
  std::array<double, 3> moment{};
  std::array<FieldFunction, 3> functions;  ///< one that is set replaces that component of `moment`
};

/// The moments at the nodes of the cell that do the same work on rotations that are linear between the nodes: on the
/// drilling rotation as well, where the moment has a part about the normal.
std::vector<NodalForce> plate_moment_forces(const Mesh& mesh, const PlateMoment& load);

}  // namespace comma::solver
