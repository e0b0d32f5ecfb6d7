// The own axes of a flat plate, and how far from flat its cell is.
#pragma once

#include <Eigen/Dense>

#include "solver/elements/slender/section.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Rows: x along the part of the section's direction in the plane of the cell, y across, z along the normal by the
/// order of the corners (U4.42.01, COQUE). Throws Error `distorted-cell` for a cell without area, `zero-vector` for a
/// direction along the normal.
Eigen::Matrix3d plate_axes(const Mesh& mesh, int cell, const PlateSection& section);

/// By how much a corner of a quadrangle lies off the plane through another that is normal to the plate, as a share of
/// the cell's size: the plate is the cell's projection on that plane.
double warp_of_plate(const Mesh& mesh, int cell);
/// Of less than this the plate knows nothing.
inline constexpr double little_warp = 1e-3;

}  // namespace comma::solver
