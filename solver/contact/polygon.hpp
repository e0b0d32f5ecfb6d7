// Polygons in the plane: clipping, and triangles for integration.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Dense>

namespace comma::solver {

using Polygon = std::vector<Eigen::Vector2d>;

/// Positive for corners that go counter-clockwise.
double signed_area(const Polygon& polygon);

/// The part of a polygon inside a convex one, both counter-clockwise (Sutherland and Hodgman, Communications of the ACM
/// 17, 1974). Empty where they have no area in common.
Polygon clipped(const Polygon& polygon, const Polygon& convex);

}  // namespace comma::solver
