// The own axes of a flat plate.
#pragma once

#include <Eigen/Dense>

#include "solver/elements/section.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Rows: x along the part of the section's direction in the plane of the cell, y across, z along the normal by the order of the corners (U4.42.01,
/// COQUE). Throws Error `distorted-cell` for a cell without area, `zero-vector` for a direction along the normal.
Eigen::Matrix3d plate_axes(const Mesh& mesh, int cell, const PlateSection& section);

}  // namespace comma::solver
