#include "solver/io/med_localization.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "solver/elements/quadrature.hpp"
#include "solver/elements/slender/beam_points.hpp"
#include "solver/error.hpp"
#include "solver/mesh/reference_cell.hpp"

namespace comma::solver {
namespace {

GaussScheme centre(CellType type) {
  const auto nodes = reference_points(type);
  const int corners = corner_count(type);
  Point middle{};
  for (int i = 0; i < corners; ++i) {
    for (int axis = 0; axis < 3; ++axis) middle[axis] += nodes[i][axis] / corners;
  }
  if (corners == 5) middle = {0.0, 0.0, 0.25};  // the centroid of a pyramid is not the mean of its corners
  return {{middle}, {reference_measure(type)}};
}

/// The values of discrete elements stand at their ends, the first one first, those of beams in the middle too.
GaussScheme ends() { return {{{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {1.0, 1.0}}; }
GaussScheme ends_and_middle() {
  return {{{-1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {1.0 / 3.0, 4.0 / 3.0, 1.0 / 3.0}};
}

}  // namespace

std::optional<GaussScheme> gauss_scheme(CellType type, int points) {
  if (points == 1) return centre(type);
  if (corner_count(type) == 2 && points == 2) return ends();
  if (type == CellType::seg2 && points == beam_point_count) return ends_and_middle();
  try {
    GaussScheme scheme;
    for (const QuadraturePoint& point : quadrature(type, fmt::format("FPG{}", points))) {
      Point at{};
      std::copy(point.at.begin(), point.at.end(), at.begin());
      scheme.points.push_back(at);
      scheme.weights.push_back(point.weight);
    }
    return scheme;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace comma::solver
