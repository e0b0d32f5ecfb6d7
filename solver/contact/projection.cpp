#include "solver/contact/projection.hpp"

#include <algorithm>
#include <cmath>

namespace comma::solver {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int max_newton_iterations = 60;
/// Reference coordinates are of order one: a step below this no longer moves the foot.
constexpr double step_tolerance = 1e-14;
constexpr double place_tolerance = 1e-4;
/// Where plain iterations go so far they are not trusted.
constexpr double far_from_facet = 5.0;
/// Beyond this a foot is far outside whatever tolerance a user gives, and only needs to be known as such.
constexpr double far_outside = 50.0;
/// A facet that is this thin, as a share of its size squared, is seen from its edge.
constexpr double edge_on = 1e-9;

struct Local {
  Vector3d offset;  ///< foot minus node
  Eigen::Matrix<double, 3, 2> tangents;
};

Local evaluate(const Vector3d& node, CellType type, std::span<const Vector3d> points, const Vector2d& xi) {
  const FacetShape shape = facet_shape(type, xi);
  Local local{-node, Eigen::Matrix<double, 3, 2>::Zero()};
  for (std::size_t i = 0; i < points.size(); ++i) {
    local.offset += shape.values[i] * points[i];
    local.tangents += points[i] * shape.gradients[i].transpose();
  }
  return local;
}

/// offset . second derivatives of the position. Tangents are polynomials of degree two at most in each coordinate, for
/// which a central difference is exact whatever its width.
Matrix2d curvature(CellType type, std::span<const Vector3d> points, const Vector2d& xi, const Vector3d& offset) {
  Matrix2d result;
  for (int direction = 0; direction < 2; ++direction) {
    const Vector2d half = 0.5 * Vector2d::Unit(direction);
    result.col(direction) =
        (facet_tangents(type, points, xi + half) - facet_tangents(type, points, xi - half)).transpose() * offset;
  }
  return 0.5 * (result + result.transpose());
}

enum class Descent : bool { no, yes };

Vector2d newton_step(const Local& local, const Matrix2d& bending, bool is_line, Descent descent) {
  const Vector2d gradient = local.tangents.transpose() * local.offset;
  Matrix2d metric = local.tangents.transpose() * local.tangents;
  if (is_line) {
    const double hessian = metric(0, 0) + bending(0, 0);
    const bool convex = descent == Descent::no || hessian > 0.1 * metric(0, 0);
    return {-gradient[0] / (convex ? hessian : metric(0, 0)), 0.0};
  }
  const Matrix2d hessian = metric + bending;
  // Away from the foot of a curved facet the distance may not be convex: Gauss-Newton then still goes down.
  const bool convex =
      descent == Descent::no || (hessian.trace() > 0.0 && hessian.determinant() > 0.01 * metric.determinant());
  return -(convex ? hessian : metric).inverse() * gradient;
}

bool is_convex(const Local& local, const Matrix2d& bending, bool is_line) {
  const Matrix2d hessian = local.tangents.transpose() * local.tangents + bending;
  return is_line ? hessian(0, 0) > 0.0 : hessian.trace() > 0.0 && hessian.determinant() > 0.0;
}

/// Where Newton's method ends and where its last step began.
struct Foot {
  Vector2d xi, from;
  bool is_nearest = true;  ///< not a place that is farthest, or a saddle
};

/// Newton's method as it is, from the centre of the facet, until a step is a ten-thousandth of the place.
std::optional<Foot> plain_foot(const Vector3d& node, CellType type, std::span<const Vector3d> points) {
  Vector2d xi = facet_centre(type);
  for (int iteration = 0; iteration < max_newton_iterations && xi.norm() < far_from_facet; ++iteration) {
    const Local local = evaluate(node, type, points, xi);
    const Matrix2d bending = curvature(type, points, xi, local.offset);
    const Vector2d step = newton_step(local, bending, dimension(type) == 1, Descent::no);
    if (!step.allFinite()) return std::nullopt;
    const Vector2d from = xi;
    xi += step;
    const double size = xi.norm();
    if (step.norm() <= place_tolerance * (size > 0.0 ? size : 1.0))
      return Foot{xi, from, is_convex(local, bending, dimension(type) == 1)};
  }
  return std::nullopt;
}

/// Going down from the centre of the facet, however bent it is.
std::optional<Foot> safe_foot(const Vector3d& node, CellType type, std::span<const Vector3d> points) {
  Vector2d xi = facet_centre(type);
  for (int iteration = 0; iteration < max_newton_iterations; ++iteration) {
    const Local local = evaluate(node, type, points, xi);
    Vector2d step = newton_step(local, curvature(type, points, xi, local.offset), dimension(type) == 1, Descent::yes);
    if (!step.allFinite()) break;
    const double before = local.offset.squaredNorm();
    for (int halving = 0; halving < 8; ++halving) {
      if (evaluate(node, type, points, xi + step).offset.squaredNorm() <= before * (1.0 + 1e-12)) break;
      step *= 0.5;
    }
    xi += step;
    const bool rests = step.norm() <= step_tolerance * (1.0 + xi.norm()) || xi.norm() > far_outside;
    // Rounding in large coordinates can keep the step from getting smaller still.
    if (rests || (iteration > 20 && step.norm() < 1e-9)) return Foot{xi, xi};
  }
  return std::nullopt;
}

std::optional<Projection> brought_back(const std::optional<Foot>& foot, const Vector3d& node, CellType type,
                                       std::span<const Vector3d> points) {
  if (!foot) return std::nullopt;
  Projection projection;
  projection.outside = outside_distance(type, foot->xi);
  projection.xi = bring_back(type, foot->xi);
  projection.from = foot->from;
  const FacetShape shape = facet_shape(type, projection.xi);
  projection.weights = shape.values;
  projection.foot.setZero();
  for (std::size_t i = 0; i < points.size(); ++i) projection.foot += shape.values[i] * points[i];
  projection.distance = (projection.foot - node).norm();
  return projection;
}

}  // namespace

std::optional<Projection> project(const Vector3d& node, CellType type, std::span<const Vector3d> points) {
  const std::optional<Foot> plain = plain_foot(node, type, points);
  if (plain && plain->is_nearest) return brought_back(plain, node, type, points);
  const std::optional<Foot> safe = safe_foot(node, type, points);
  const bool faces = safe && outside_distance(type, safe->xi) == 0.0;
  return brought_back(plain && !faces ? plain : safe, node, type, points);
}

std::optional<Projection> project_exactly(const Vector3d& node, CellType type, std::span<const Vector3d> points) {
  return brought_back(safe_foot(node, type, points), node, type, points);
}

/// Seen along the direction, the place that is asked for is the foot of the node.
std::optional<Projection> project_along(const Vector3d& direction, const Vector3d& node, CellType type,
                                        std::span<const Vector3d> points) {
  const Vector3d along = direction.normalized();
  const auto seen = [&](const Vector3d& place) -> Vector3d { return place - along.dot(place) * along; };
  std::array<Vector3d, max_facet_nodes> flat;
  double size = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    flat[i] = seen(points[i]);
    size = std::max(size, (points[i] - points[0]).norm());
  }
  const std::span<const Vector3d> view(flat.data(), points.size());
  const double area = (dimension(type) == 1 ? size : 1.0) * facet_stretch(type, view, facet_centre(type), false);
  if (!(area > edge_on * size * size)) return std::nullopt;
  auto found = project(seen(node), type, view);
  if (!found) return std::nullopt;
  found->foot.setZero();
  for (std::size_t i = 0; i < points.size(); ++i) found->foot += found->weights[i] * points[i];
  found->distance = (found->foot - node).norm();
  return found;
}

}  // namespace comma::solver
