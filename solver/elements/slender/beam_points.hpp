// Where results have the section forces of beams: at the first end, in the middle and at the second end, as Code_Aster
// 17.3 has them. Between the ends they are linear.
#pragma once

#include <span>

namespace comma::solver {

inline constexpr int beam_point_count = 3;

/// Of the values at the points of one beam, `each` at a point: those at an end, 0 or 1.
inline std::span<const double> at_end(std::span<const double> points, std::size_t each, int end) {
  return points.subspan(end == 0 ? 0 : (beam_point_count - 1) * each, each);
}

/// Writes the values at the three points from those at both ends, first end first.
inline void write_at_points(std::span<const double> ends, std::span<double> points) {
  const std::size_t each = ends.size() / 2;
  for (std::size_t i = 0; i < each; ++i) {
    points[i] = ends[i];
    points[each + i] = 0.5 * (ends[i] + ends[each + i]);
    points[2 * each + i] = ends[each + i];
  }
}

}  // namespace comma::solver
