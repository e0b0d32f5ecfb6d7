// What a slave facet and a master facet have in common, seen along the slave's normal: mortar segments and polygons.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/facet.hpp"

namespace comma::solver {

/// A facet where it is now. `points`: one a node; `normals`: outward unit normals at the nodes, interpolated between them; empty:
/// the facet's own are meant.
struct FacetGeometry {
  CellType type;
  std::span<const Eigen::Vector3d> points;
  std::span<const Eigen::Vector3d> normals;
};

/// Outward unit normal at a reference point. Throws Error `degenerate-facet`.
Eigen::Vector3d normal_at(const FacetGeometry& facet, const Eigen::Vector2d& xi);
Eigen::Vector3d point_at(const FacetGeometry& facet, const Eigen::Vector2d& xi);

/// An integration point: places in the reference cells of both facets that face each other.
struct OverlapPoint {
  Eigen::Vector2d slave;
  Eigen::Vector2d master;
  double weight = 0.0;  ///< in the slave's reference cell: all points of a slave facet that is wholly covered add up to its measure
};

/// Points of the common part; none where the facets do not overlap or do not face each other.
///
/// Lines: the ends of the master are brought onto the slave along the slave's normals, and Gauss points of the segment between go
/// back onto the master along them (Puso and Laursen, Computer Methods in Applied Mechanics and Engineering 193, 2004, in the
/// plane). Surfaces: both outlines are projected on the plane of the slave's centre, clipped there, and the polygon is
/// integrated by triangles. Straight-edged facets tile the plane: overlaps with all masters add up to the whole slave.
std::vector<OverlapPoint> facet_overlap(const FacetGeometry& slave, const FacetGeometry& master);

}  // namespace comma::solver
