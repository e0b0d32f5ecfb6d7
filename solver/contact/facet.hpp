// Shape functions of contact facets: lines in the plane or in space, triangles and quadrangles in space.
#pragma once

#include <array>
#include <span>

#include <Eigen/Dense>

#include "solver/mesh/cell_type.hpp"

namespace comma::solver {

inline constexpr int max_facet_nodes = 9;

/// Values and derivatives at a reference point. Lines use xi[0] in [-1, 1]; triangles xi >= 0, xi[0] + xi[1] <= 1;
/// quadrangles [-1, 1]^2. Nodes in the order of CellType.
struct FacetShape {
  std::array<double, max_facet_nodes> values{};
  std::array<Eigen::Vector2d, max_facet_nodes> gradients{};
};

/// Throws Error `unsupported` for a cell that is no facet (SEG2/3, TRIA3/6/7, QUAD4/8/9).
FacetShape facet_shape(CellType type, const Eigen::Vector2d& xi);

/// Reference coordinates of a facet's node.
Eigen::Vector2d facet_node(CellType type, int node);
Eigen::Vector2d facet_centre(CellType type);

/// How far a reference point lies from the nearest point of the reference cell, in reference coordinates; 0 inside
/// (TOLE_PROJ_EXT is compared with it, beside corners and slanted edges too: Code_Aster 17.3).
double outside_distance(CellType type, const Eigen::Vector2d& xi);
/// The nearest point of the reference cell.
Eigen::Vector2d bring_back(CellType type, const Eigen::Vector2d& xi);

/// Columns; the second is zero on a line.
using Tangents = Eigen::Matrix<double, 3, 2>;
/// At a reference point; `points`: one a node.
Tangents facet_tangents(CellType type, std::span<const Eigen::Vector3d> points, const Eigen::Vector2d& xi);

/// Area (length of a line) a unit of the reference cell's; with `times_radius`, of what turns round the axis x = 0 by a
/// radian.
double facet_stretch(CellType type, std::span<const Eigen::Vector3d> points, const Eigen::Vector2d& xi,
                     bool times_radius);

/// Unit normal: on the right of a line in the plane (the outer side of an edge that goes counter-clockwise round its
/// face), the cross product of the tangents on a surface. Throws Error `degenerate-facet` where it vanishes.
Eigen::Vector3d facet_normal(CellType type, std::span<const Eigen::Vector3d> points, const Eigen::Vector2d& xi);
Eigen::Vector3d facet_normal(CellType type, const Tangents& tangents);

}  // namespace comma::solver
