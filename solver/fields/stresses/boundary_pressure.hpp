// What a body's stress presses with upon its boundary (CALC_PRESSION, U4.81.43).
#pragma once

#include <span>

#include <Eigen/Dense>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// Throws Error `wrong-surface` for a cell of as many dimensions as the mesh. "PRES_R" at the nodes of the boundary
/// `cells` (absent elsewhere): PRES = n . S n, negative where the boundary is pressed; in the plane the traction along
/// the boundary VX VY = S n - (n . S n) n too, and its length CISA (in space Code_Aster 17.3 gives PRES alone). S: a
/// nodal field SIXX SIYY SIZZ SIXY (SIXZ SIYZ); n: the outward normal at `positions` (one a node of the mesh), the mean
/// of those of the cells around. Throws Error `incompatible-field` for a field without stresses; nodes that carry none
/// stay absent.
NodalField boundary_pressure(const Mesh& mesh, const NodalField& stresses, std::span<const int> cells,
                             std::span<const Eigen::Vector3d> positions);

}  // namespace comma::solver
