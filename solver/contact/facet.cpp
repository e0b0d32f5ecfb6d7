#include "solver/contact/facet.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector2d;

/// Corners, mid-edges and centre of the square, in the order of QUAD9.
constexpr std::array<std::array<double, 2>, 9> square_places = {
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}}};
constexpr std::array<std::array<double, 2>, 7> triangle_places = {
    {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}, {1.0 / 3, 1.0 / 3}}};

struct LinePolynomial {
  double value;
  double slope;
};

/// The polynomial on [-1, 1] that is one at `node` and zero at the other nodes of the line.
LinePolynomial linear(double node, double x) { return {0.5 * (1 + node * x), 0.5 * node}; }
LinePolynomial quadratic(double node, double x) {
  if (node == 0) return {1 - x * x, -2 * x};
  return {0.5 * x * (x + node), x + 0.5 * node};
}

template <class Polynomial>
FacetShape tensor(int nodes, const Vector2d& xi, Polynomial polynomial) {
  FacetShape shape;
  for (int i = 0; i < nodes; ++i) {
    const LinePolynomial a = polynomial(square_places[i][0], xi[0]);
    const LinePolynomial b = polynomial(square_places[i][1], xi[1]);
    shape.values[i] = a.value * b.value;
    shape.gradients[i] = {a.slope * b.value, a.value * b.slope};
  }
  return shape;
}

template <class Polynomial>
FacetShape line(int nodes, double x, Polynomial polynomial) {
  constexpr std::array<double, 3> at = {-1, 1, 0};
  FacetShape shape;
  for (int i = 0; i < nodes; ++i) {
    const LinePolynomial a = polynomial(at[i], x);
    shape.values[i] = a.value;
    shape.gradients[i] = {a.slope, 0.0};
  }
  return shape;
}

FacetShape serendipity(const Vector2d& xi) {
  FacetShape shape;
  const double x = xi[0];
  const double y = xi[1];
  for (int i = 0; i < 4; ++i) {
    const double a = square_places[i][0];
    const double b = square_places[i][1];
    shape.values[i] = 0.25 * (1 + a * x) * (1 + b * y) * (a * x + b * y - 1);
    shape.gradients[i] = {0.25 * a * (1 + b * y) * (2 * a * x + b * y), 0.25 * b * (1 + a * x) * (a * x + 2 * b * y)};
  }
  for (int i = 4; i < 8; ++i) {
    const double a = square_places[i][0];
    const double b = square_places[i][1];
    if (a == 0) {
      shape.values[i] = 0.5 * (1 - x * x) * (1 + b * y);
      shape.gradients[i] = {-x * (1 + b * y), 0.5 * b * (1 - x * x)};
    } else {
      shape.values[i] = 0.5 * (1 + a * x) * (1 - y * y);
      shape.gradients[i] = {0.5 * a * (1 - y * y), -y * (1 + a * x)};
    }
  }
  return shape;
}

const std::array<Vector2d, 3>& barycentric_gradients() {
  static const std::array<Vector2d, 3> gradients = {Vector2d(-1, -1), Vector2d(1, 0), Vector2d(0, 1)};
  return gradients;
}

FacetShape triangle(int nodes, const Vector2d& xi) {
  const std::array<double, 3> l = {1 - xi[0] - xi[1], xi[0], xi[1]};
  const auto& g = barycentric_gradients();
  FacetShape shape;
  if (nodes == 3) {
    for (int i = 0; i < 3; ++i) {
      shape.values[i] = l[i];
      shape.gradients[i] = g[i];
    }
    return shape;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    shape.values[i] = l[i] * (2 * l[i] - 1);
    shape.gradients[i] = (4 * l[i] - 1) * g[i];
    shape.values[3 + i] = 4 * l[i] * l[j];
    shape.gradients[3 + i] = 4 * (l[i] * g[j] + l[j] * g[i]);
  }
  if (nodes == 6) return shape;
  // TRIA7: a bubble at the centre, taken off the others so that they vanish there.
  const double bubble = 27 * l[0] * l[1] * l[2];
  const Vector2d slope = 27 * (l[1] * l[2] * g[0] + l[0] * l[2] * g[1] + l[0] * l[1] * g[2]);
  for (int i = 0; i < 6; ++i) {
    const double at_centre = i < 3 ? -1.0 / 9 : 4.0 / 9;
    shape.values[i] -= at_centre * bubble;
    shape.gradients[i] -= at_centre * slope;
  }
  shape.values[6] = bubble;
  shape.gradients[6] = slope;
  return shape;
}

enum class Family : std::uint8_t { line, triangle, quadrangle };

Family family_of(CellType type) {
  switch (type) {
    case CellType::seg2:
    case CellType::seg3:
      return Family::line;
    case CellType::tria3:
    case CellType::tria6:
    case CellType::tria7:
      return Family::triangle;
    case CellType::quad4:
    case CellType::quad8:
    case CellType::quad9:
      return Family::quadrangle;
    default:
      throw Error("unsupported", fmt::format("a {} cell cannot be a contact facet", name_of(type)),
                  "contact surfaces are made of SEG2, SEG3, TRIA3, TRIA6, TRIA7, QUAD4, QUAD8 or QUAD9 cells; a POI1 "
                  "may be a slave in FORMULATION='DISCRETE', with NORMALE='MAIT' or VECT_ESCL='FIXE'");
  }
}

}  // namespace

FacetShape facet_shape(CellType type, const Vector2d& xi) {
  switch (type) {
    case CellType::seg2:
      return line(2, xi[0], linear);
    case CellType::seg3:
      return line(3, xi[0], quadratic);
    case CellType::quad4:
      return tensor(4, xi, linear);
    case CellType::quad8:
      return serendipity(xi);
    case CellType::quad9:
      return tensor(9, xi, quadratic);
    default:
      break;
  }
  if (family_of(type) == Family::triangle) return triangle(node_count(type), xi);
  throw Error("unsupported", fmt::format("no shape functions for a {} facet", name_of(type)));
}

Vector2d facet_node(CellType type, int node) {
  if (type == CellType::poi1) return {};
  switch (family_of(type)) {
    case Family::line:
      return {node == 2 ? 0.0 : 2.0 * node - 1.0, 0.0};
    case Family::triangle:
      return {triangle_places[node][0], triangle_places[node][1]};
    case Family::quadrangle:
      return {square_places[node][0], square_places[node][1]};
  }
  return {};
}

Vector2d facet_centre(CellType type) {
  return family_of(type) == Family::triangle ? Vector2d(1.0 / 3, 1.0 / 3) : Vector2d(0.0, 0.0);
}

double outside_distance(CellType type, const Vector2d& xi) { return (bring_back(type, xi) - xi).norm(); }

Vector2d bring_back(CellType type, const Vector2d& xi) {
  if (family_of(type) == Family::line) return {std::clamp(xi[0], -1.0, 1.0), 0.0};
  if (family_of(type) == Family::quadrangle) return {std::clamp(xi[0], -1.0, 1.0), std::clamp(xi[1], -1.0, 1.0)};
  const Vector2d clamped(std::clamp(xi[0], 0.0, 1.0), std::clamp(xi[1], 0.0, 1.0));
  if (xi[0] + xi[1] <= 1.0) return clamped;
  const double along = std::clamp(0.5 * (1.0 + xi[0] - xi[1]), 0.0, 1.0);  // foot on the slanted edge
  const Vector2d on_edge(along, 1.0 - along);
  return clamped.sum() <= 1.0 && (clamped - xi).norm() < (on_edge - xi).norm() ? clamped : on_edge;
}

Tangents facet_tangents(CellType type, std::span<const Eigen::Vector3d> points, const Vector2d& xi) {
  const FacetShape shape = facet_shape(type, xi);
  Tangents tangents = Tangents::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) tangents += points[i] * shape.gradients[i].transpose();
  return tangents;
}

double facet_stretch(CellType type, std::span<const Eigen::Vector3d> points, const Vector2d& xi, bool times_radius) {
  const Tangents tangents = facet_tangents(type, points, xi);
  const double stretch = family_of(type) == Family::line
                             ? tangents.col(0).norm()
                             : Eigen::Vector3d(tangents.col(0)).cross(Eigen::Vector3d(tangents.col(1))).norm();
  if (!times_radius) return stretch;
  const FacetShape shape = facet_shape(type, xi);
  double radius = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) radius += shape.values[i] * points[i][0];
  return radius * stretch;
}

Eigen::Vector3d facet_normal(CellType type, std::span<const Eigen::Vector3d> points, const Vector2d& xi) {
  return facet_normal(type, facet_tangents(type, points, xi));
}

Eigen::Vector3d facet_normal(CellType type, const Tangents& tangents) {
  Eigen::Vector3d normal;
  if (family_of(type) == Family::line) {
    normal = {tangents(1, 0), -tangents(0, 0), 0.0};
  } else {
    normal = Eigen::Vector3d(tangents.col(0)).cross(Eigen::Vector3d(tangents.col(1)));
  }
  const double length = normal.norm();
  if (!(length > 0.0))
    throw Error("degenerate-facet", "a contact facet has no normal: its nodes coincide or are aligned");
  return normal / length;
}

}  // namespace comma::solver
