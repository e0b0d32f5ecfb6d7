#include "solver/io/med_localization.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "solver/mesh/reference_cell.hpp"

namespace comma::solver {
namespace {

enum class Shape { point, line, triangle, quadrangle, tetrahedron, pyramid, wedge, hexahedron };

Shape shape_of(CellType type) {
  switch (corner_count(type)) {
    case 1:
      return Shape::point;
    case 2:
      return Shape::line;
    case 3:
      return Shape::triangle;
    case 4:
      return dimension(type) == 2 ? Shape::quadrangle : Shape::tetrahedron;
    case 5:
      return Shape::pyramid;
    case 6:
      return Shape::wedge;
    default:
      return Shape::hexahedron;
  }
}

double reference_size(Shape shape) {
  static constexpr std::array<double, 8> sizes = {1.0, 2.0, 0.5, 4.0, 1.0 / 6.0, 2.0 / 3.0, 1.0, 8.0};
  return sizes[static_cast<std::size_t>(shape)];
}

struct LineRule {
  std::vector<double> points;
  std::vector<double> weights;
};

LineRule line_rule(int points) {
  if (points == 2) return {{-1.0 / std::numbers::sqrt3, 1.0 / std::numbers::sqrt3}, {1.0, 1.0}};
  const double a = std::sqrt(0.6);
  return {{-a, 0.0, a}, {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0}};
}

GaussScheme centre(CellType type, Shape shape) {
  const auto nodes = reference_points(type);
  const int corners = corner_count(type);
  Point middle{};
  for (int i = 0; i < corners; ++i) {
    for (int axis = 0; axis < 3; ++axis) middle[axis] += nodes[i][axis] / corners;
  }
  if (shape == Shape::pyramid) middle = {0.0, 0.0, 0.25};  // its centroid is not the mean of its corners
  return {{middle}, {reference_size(shape)}};
}

GaussScheme line(int points) {
  const LineRule rule = line_rule(points);
  GaussScheme scheme;
  for (int i = 0; i < points; ++i) scheme.points.push_back({rule.points[i], 0.0, 0.0});
  scheme.weights = rule.weights;
  return scheme;
}

/// The corners first, then the middles of the sides, then the centre, like the nodes of a quadrangle.
GaussScheme quadrangle(int points) {
  const LineRule rule = line_rule(points == 4 ? 2 : 3);
  const int last = points == 4 ? 1 : 2;
  static constexpr std::array<std::array<int, 2>, 9> places = {
      {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}}};
  GaussScheme scheme;
  for (int i = 0; i < points; ++i) {
    const int x = points == 4 ? places[i][0] / 2 * last : places[i][0];
    const int y = points == 4 ? places[i][1] / 2 * last : places[i][1];
    scheme.points.push_back({rule.points[x], rule.points[y], 0.0});
    scheme.weights.push_back(rule.weights[x] * rule.weights[y]);
  }
  return scheme;
}

GaussScheme hexahedron(int side) {
  const LineRule rule = line_rule(side);
  GaussScheme scheme;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      for (int k = 0; k < side; ++k) {
        scheme.points.push_back({rule.points[i], rule.points[j], rule.points[k]});
        scheme.weights.push_back(rule.weights[i] * rule.weights[j] * rule.weights[k]);
      }
    }
  }
  return scheme;
}

GaussScheme triangle() {
  const double a = 1.0 / 6.0;
  const double b = 2.0 / 3.0;
  return {{{a, a, 0}, {b, a, 0}, {a, b, 0}}, {a, a, a}};
}

GaussScheme tetrahedron(int points) {
  if (points == 4) {
    const double a = (5.0 - std::sqrt(5.0)) / 20.0;
    const double b = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0;
    return {{{a, a, a}, {a, a, b}, {a, b, a}, {b, a, a}}, std::vector<double>(4, 1.0 / 24.0)};
  }
  const double a = 0.25;
  const double b = 1.0 / 6.0;
  const double c = 0.5;
  return {{{a, a, a}, {b, b, b}, {b, b, c}, {b, c, b}, {c, b, b}}, {-2.0 / 15.0, 0.075, 0.075, 0.075, 0.075}};
}

GaussScheme wedge() {
  GaussScheme scheme;
  for (const double x : line_rule(2).points) {
    scheme.points.insert(scheme.points.end(), {Point{x, 0.5, 0.5}, Point{x, 0.0, 0.5}, Point{x, 0.5, 0.0}});
  }
  scheme.weights.assign(6, 1.0 / 6.0);
  return scheme;
}

GaussScheme pyramid() {
  const double low = 0.1531754163448146;
  const double high = 0.6372983346207416;
  return {{{0.5, 0, low}, {0, 0.5, low}, {-0.5, 0, low}, {0, -0.5, low}, {0, 0, high}},
          std::vector<double>(5, 2.0 / 15.0)};
}

}  // namespace

std::optional<GaussScheme> gauss_scheme(CellType type, int points) {
  const Shape shape = shape_of(type);
  if (points == 1) return centre(type, shape);
  if (shape == Shape::line && (points == 2 || points == 3)) return line(points);
  if (shape == Shape::triangle && points == 3) return triangle();
  if (shape == Shape::quadrangle && (points == 4 || points == 9)) return quadrangle(points);
  if (shape == Shape::tetrahedron && (points == 4 || points == 5)) return tetrahedron(points);
  if (shape == Shape::wedge && points == 6) return wedge();
  if (shape == Shape::pyramid && points == 5) return pyramid();
  if (shape == Shape::hexahedron && points == 8) return hexahedron(2);
  if (shape == Shape::hexahedron && points == 27) return hexahedron(3);
  return std::nullopt;
}

}  // namespace comma::solver
