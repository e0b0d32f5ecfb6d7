// What a slave facet and a master facet have in common, seen along the slave's normals: mortar segments and polygons.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/face_rule.hpp"
#include "solver/contact/facet.hpp"

namespace comma::solver {

/// A facet where it is now: one point a node.
struct FacetGeometry {
  CellType type;
  std::span<const Eigen::Vector3d> points;
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

/// Which part of the slave faces the master is decided by corners: those of the master (ends of lines) are projected
/// on the line through the slave's ends or the plane through its first three corners, and what is common there has the
/// reference coordinates that it would have if the slave's edges were straight. Overlaps with all masters so add up to
/// the whole slave, whatever middle nodes do. Each place of that part faces the master along the slave's own normal
/// there, on a curved slave too (Puso and Laursen, Computer Methods in Applied Mechanics and Engineering 193, 2004, in
/// the plane); the master's part lies between the places that the corners of the slave's part face so. Three Gauss
/// points a segment, six a triangle, on either side. R5.03.55 leaves all this open: Code_Aster 17.3 tells it, by the
/// rigid faces that it pushes on bent ones (to 1e-12; `testcases/contact/lac_bent`).
FacetOverlap facet_overlap(const FacetGeometry& slave, const FacetGeometry& master);

}  // namespace comma::solver
