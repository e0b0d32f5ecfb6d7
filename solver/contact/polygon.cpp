#include "solver/contact/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace comma::solver {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The part on the left of the line from `a` to `b`.
Polygon left_of(const Polygon& polygon, const Vector2d& a, const Vector2d& b) {
  const auto side = [&](const Vector2d& point) { return cross(b - a, point - a); };
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& here = polygon[i];
    const Vector2d& next = polygon[(i + 1) % polygon.size()];
    const double s = side(here);
    const double t = side(next);
    if (s >= 0.0) kept.push_back(here);
    if ((s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0)) kept.push_back(here + s / (s - t) * (next - here));
  }
  return kept;
}

}  // namespace

double signed_area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return twice / 2.0;
}

Polygon clipped(const Polygon& polygon, const Polygon& convex) {
  Polygon result = polygon;
  for (std::size_t i = 0; i < convex.size() && result.size() > 2; ++i)
    result = left_of(result, convex[i], convex[(i + 1) % convex.size()]);
  return result.size() > 2 && signed_area(result) > 0.0 ? result : Polygon();
}

Polygon about_mean(Polygon polygon) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& corner : polygon) mean += corner / static_cast<double>(polygon.size());
  std::ranges::sort(polygon, {},
                    [&](const Vector2d& corner) { return std::atan2(corner[0] - mean[0], corner[1] - mean[1]); });
  return polygon;
}

std::vector<std::array<std::size_t, 3>> triangles_of(std::size_t corners) {
  std::vector<std::size_t> left(corners);
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<std::array<std::size_t, 3>> triangles;
  while (left.size() > 2) {
    triangles.push_back({left[0], left[1], left[2]});
    left.erase(left.begin() + 1);
    std::ranges::rotate(left, left.begin() + 1);
  }
  return triangles;
}

}  // namespace comma::solver
