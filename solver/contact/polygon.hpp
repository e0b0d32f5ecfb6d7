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

/// The corners of a convex polygon clockwise about their mean, from where the second axis is most negative.
Polygon about_mean(Polygon polygon);

/// The triangles that make up a convex polygon of so many corners, three of these each: from the first corner on every
/// second one is cut off, round after round.
std::vector<std::array<std::size_t, 3>> triangles_of(std::size_t corners);

}  // namespace comma::solver
