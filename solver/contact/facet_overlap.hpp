// What a slave facet and a master facet have in common, seen along the slave's normal: mortar segments and polygons.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/face_rule.hpp"
#include "solver/contact/facet.hpp"

namespace comma::solver {

/// A facet where it is now. `points`: one a node; `normals`: outward unit normals at the nodes, interpolated between
/// them; empty: the facet's own are meant.
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
  /// In the slave's reference cell: all points of a slave facet that is wholly covered add up to its measure.
  double weight = 0.0;
};

/// What two facets have in common, integrated on either side: both empty where they do not overlap or do not face each
/// other (normals that are within 5.7 degrees of a right angle do not).
struct FacetOverlap {
  std::vector<OverlapPoint> points;
  /// Points and weights in the master's reference cell, of its part that the slave faces.
  std::vector<FacePoint> master;
};

/// Both facets by their own normals, whatever `normals` say.
///
/// Lines: the ends of the master are brought onto the slave along the slave's normals, and places of the segment
/// between go back onto the master along them (Puso and Laursen, Computer Methods in Applied Mechanics and Engineering
/// 193, 2004, in the plane). Surfaces: the corners of both are projected on the plane of the slave's corners, the
/// polygons are clipped there: quadratic facets too count by their corners. Corners of what is common have the
/// reference coordinates that they would have if the slave's edges were straight, and face the places of the master on
/// the slave's own normals there. Between them sides are straight in the reference coordinates of either, where both
/// parts are integrated by triangles of six points. Whatever middle nodes do, overlaps with all masters add up to the
/// whole slave. Code_Aster's figures of pressures on bodies that do not deform uniformly say the same (ssnp170z, to
/// 3e-8, ssnp170r, to 2e-7; with bent edges 1e-5); surfaces of HEXA20 and TETRA10 that begin flat agree to 1e-10.
FacetOverlap facet_overlap(const FacetGeometry& slave, const FacetGeometry& master);

}  // namespace comma::solver
