// Where the nodes of the reference cells lie (R3.01.01).
#pragma once

#include <array>
#include <vector>

#include "solver/mesh/cell_type.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Coordinates of all nodes of the reference cell in Code_Aster's order; coordinates beyond the cell's dimension are 0.
/// Lines, quadrangles and hexahedra span [-1, 1]; triangles lie between (0,0), (1,0), (0,1); tetrahedra, wedges and
/// pyramids as in R3.01.01.
std::vector<Point> reference_points(CellType type);

/// The pairs of corners between which the mid-edge nodes of the cell lie, in the order of those nodes (SEG4 has none).
std::vector<std::array<int, 2>> middle_edges(CellType type);
/// The corners between which its mid-face nodes lie, in their order; for QUAD9 the corners of the cell.
std::vector<std::array<int, 4>> middle_faces(CellType type);

}  // namespace comma::solver
