// The integration schemes that MED files need to place the values of a field at Gauss points.
#pragma once

#include <optional>
#include <vector>

#include "solver/mesh/cell_type.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Points in the coordinates of the reference cell (reference_points) and their weights.
struct GaussScheme {
  std::vector<Point> points;
  std::vector<double> weights;
};

/// The scheme of R3.01.01 with that many points on that cell type, in its order of points, as elements have it; nothing
/// if there is none. One point is the centre of any cell, two points of a line are its ends, and three of a SEG2 its
/// ends and its middle, where beams have their forces.
std::optional<GaussScheme> gauss_scheme(CellType type, int points);

}  // namespace comma::solver
