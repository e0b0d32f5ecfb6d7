// Reference cells: node coordinates and shape functions of every cell type, in the order of R3.01.01.
#pragma once

#include <array>
#include <span>

#include <Eigen/Dense>

#include "solver/mesh/cell_type.hpp"

namespace comma::solver {

/// A point of the reference cell; coordinates past the cell's dimension are 0.
///
/// Segments, quadrangles and hexahedra span [-1, 1] in each direction; triangles have corners (0,0), (1,0), (0,1).
/// Solids with triangles follow R3.01.01, section 4: a tetrahedron's first three nodes lie in the plane x = 0, a
/// pentahedron's axis is x, a pyramid's base is the square |x| + |y| <= 1 and its apex is at z = 1.
using ReferencePoint = std::array<double, 3>;

inline constexpr int max_nodes = 27;

/// Where the nodes lie in the reference cell, one entry a node.
std::span<const ReferencePoint> reference_nodes(CellType type);

/// Length, area or volume of the reference cell (1 for a point).
double reference_measure(CellType type);

/// Values N (node_count) of the shape functions at a point.
Eigen::VectorXd shape_functions(CellType type, const ReferencePoint& at);

/// Derivatives dN_a / dxi_j (node_count x dimension), exact (forward differentiation of the same formulas). For
/// pyramids, not at the apex, where the rational functions have no gradient.
Eigen::MatrixXd shape_derivatives(CellType type, const ReferencePoint& at);

}  // namespace comma::solver
