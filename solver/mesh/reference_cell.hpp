// Where the nodes of the reference cells lie (R3.01.01).
#pragma once

#include <vector>

#include "solver/mesh/cell_type.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Coordinates of all nodes of the reference cell in Code_Aster's order; coordinates beyond the cell's dimension are 0.
/// Lines, quadrangles and hexahedra span [-1, 1]; triangles lie between (0,0), (1,0), (0,1); tetrahedra, wedges and
/// pyramids as in R3.01.01.
std::vector<Point> reference_points(CellType type);

}  // namespace comma::solver
