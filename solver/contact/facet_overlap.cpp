#include "solver/contact/facet_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "solver/contact/face_rule.hpp"
#include "solver/contact/polygon.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int most_steps = 30;
/// A step of Newton's method in reference coordinates after which what is left is rounding, since it is squared.
constexpr double last_step = 1e-9;
/// Facets whose normals are less opposite, by the cosine of the angle between one and the reverse of the other, do not
/// face each other: across a slave that stands upright on it a master has any area.
constexpr double least_facing = 0.1;
/// A common part below this share of the slave's reference measure is rounding at an edge.
constexpr double sliver = 1e-12;
/// Gauss points a segment, and the degree of the triangles' rule (FPG6): what Code_Aster's figures say of bent facets,
/// where neither is exact (17.3, to 1e-14).
constexpr int segment_points = 3;
constexpr int triangle_degree = 4;

/// A facet seen from a place near it: its distance from the origin of the mesh then costs no digits.
class Near {
 public:
  Near(const FacetGeometry& facet, const Vector3d& origin) : facet_(facet) {
    for (std::size_t i = 0; i < facet.points.size(); ++i) points_[i] = facet.points[i] - origin;
  }
  FacetGeometry geometry() const { return {facet_.type, {points_.data(), facet_.points.size()}}; }

 private:
  const FacetGeometry& facet_;
  std::array<Vector3d, max_facet_nodes> points_;
};

/// Solves value(xi) = 0 by the secant method from a first slope. Nothing where it does not settle.
template <class Function>
std::optional<double> solve_scalar(double slope, Function value) {
  double xi = 0.0;
  double here = value(xi);
  for (int k = 0; k < most_steps; ++k) {
    if (!(std::abs(slope) > 0.0)) return std::nullopt;
    const double step = -here / slope;
    xi += step;
    if (!std::isfinite(xi)) return std::nullopt;
    if (std::abs(step) <= last_step) return xi;
    const double next = value(xi);
    slope = (next - here) / step;
    here = next;
  }
  return std::nullopt;
}

double cross_in_plane(const Vector3d& a, const Vector3d& b) { return a[0] * b[1] - a[1] * b[0]; }

Vector3d tangent_at(const FacetGeometry& line, double xi) {
  return facet_tangents(line.type, line.points, {xi, 0.0}).col(0);
}

/// The reference coordinate of a place's foot on the line between the ends of a facet.
double foot_on_chord(const FacetGeometry& line, const Vector3d& place) {
  const Vector3d chord = line.points[1] - line.points[0];
  return 2.0 * chord.dot(place - line.points[0]) / chord.squaredNorm() - 1.0;
}

/// Where the slave's normal at a reference point meets a master line.
std::optional<Vector2d> met_on_line(const FacetGeometry& slave, const FacetGeometry& master, const Vector2d& at) {
  const Vector3d place = point_at(slave, at);
  const Vector3d normal = normal_at(slave, at);
  const auto hit = solve_scalar(cross_in_plane(tangent_at(master, 0.0), normal), [&](double xi) {
    return cross_in_plane(point_at(master, {xi, 0.0}) - place, normal);
  });
  if (!hit) return std::nullopt;
  return Vector2d(*hit, 0.0);
}

/// Gauss points of a part of a line's reference cell.
std::vector<FacePoint> part_rule(double begin, double end) {
  static const auto rule = face_rule(CellType::seg2, ContactRule::gauss, segment_points);
  std::vector<FacePoint> points;
  for (const FacePoint& gauss : rule)
    points.push_back(
        {{begin + 0.5 * (1.0 + gauss.xi[0]) * (end - begin), 0.0}, 0.5 * std::abs(end - begin) * gauss.weight});
  return points;
}

FacetOverlap segment_overlap(const FacetGeometry& slave, const FacetGeometry& master) {
  const double first = foot_on_chord(slave, master.points[0]);
  const double last = foot_on_chord(slave, master.points[1]);
  const double begin = std::max(-1.0, std::min(first, last));
  const double end = std::min(1.0, std::max(first, last));
  if (end - begin <= sliver) return {};
  FacetOverlap overlap;
  for (const FacePoint& at : part_rule(begin, end)) {
    const auto hit = met_on_line(slave, master, at.xi);
    if (!hit || normal_at(slave, at.xi).dot(normal_at(master, *hit)) > -least_facing) return {};
    overlap.points.push_back({at.xi, *hit, at.weight});
  }
  const auto from = met_on_line(slave, master, {begin, 0.0});
  const auto to = met_on_line(slave, master, {end, 0.0});
  if (!from || !to) return {};
  overlap.master = part_rule((*from)[0], (*to)[0]);
  return overlap;
}

/// A surface facet as its corners say: flat triangles, bilinear quadrangles.
FacetGeometry straight_edged(const FacetGeometry& facet) {
  const int corners = corner_count(facet.type);
  return {corners == 3 ? CellType::tria3 : CellType::quad4, facet.points.first(static_cast<std::size_t>(corners))};
}

class Plane {
 public:
  Plane(const Vector3d& origin, const Vector3d& normal)
      : origin_(origin), normal_(normal), first_(normal.unitOrthogonal()), second_(normal.cross(first_)) {}

  const Vector3d& normal() const { return normal_; }
  Vector2d at(const Vector3d& place) const { return along(place - origin_); }

  /// The reference point of a facet that lies over a place of the plane.
  std::optional<Vector2d> over(const FacetGeometry& facet, const Vector2d& place) const {
    Vector2d xi = facet_centre(facet.type);
    for (int k = 0; k < most_steps; ++k) {
      const Eigen::Matrix2d derivative = slope(facet, xi);
      if (!(std::abs(derivative.determinant()) > 0.0)) return std::nullopt;
      const Vector2d step = derivative.inverse() * (place - at(point_at(facet, xi)));
      xi += step;
      if (!xi.allFinite()) return std::nullopt;
      if (step.norm() <= last_step) return xi;
    }
    return std::nullopt;
  }

  /// Corners, counter-clockwise.
  Polygon outline(const FacetGeometry& facet) const {
    Polygon polygon;
    for (const Vector3d& corner : facet.points.first(static_cast<std::size_t>(corner_count(facet.type))))
      polygon.push_back(at(corner));
    if (signed_area(polygon) < 0.0) std::ranges::reverse(polygon);
    return polygon;
  }

 private:
  Vector2d along(const Vector3d& vector) const { return {first_.dot(vector), second_.dot(vector)}; }

  /// Of places on a facet, seen in the plane, by its reference coordinates.
  Eigen::Matrix2d slope(const FacetGeometry& facet, const Vector2d& xi) const {
    const auto tangents = facet_tangents(facet.type, facet.points, xi);
    Eigen::Matrix2d result;
    result << along(tangents.col(0)), along(tangents.col(1));
    return result;
  }

  Vector3d origin_, normal_, first_, second_;
};

/// Through the first three corners.
Plane plane_of(const FacetGeometry& facet) {
  return {facet.points[0], facet_normal(CellType::tria3, facet.points.first(3), {0.0, 0.0})};
}

/// Where the slave's normal at a reference point meets a master surface.
std::optional<Vector2d> met_on_surface(const FacetGeometry& slave, const FacetGeometry& master, const Vector2d& at) {
  return Plane(point_at(slave, at), normal_at(slave, at)).over(master, Vector2d::Zero());
}

bool misses(const Polygon& a, const Polygon& b) {
  const auto box = [](const Polygon& polygon) {
    Eigen::AlignedBox2d result;
    for (const Vector2d& corner : polygon) result.extend(corner);
    return result;
  };
  return !box(a).intersects(box(b));
}

/// Integration points of a part of a surface's reference cell. A corner may be slightly re-entrant, where a side that
/// is straight on the other surface is not in this cell: what lies outside counts as negative.
std::vector<FacePoint> part_rule(const Polygon& part) {
  static const auto rule = face_rule(CellType::tria3, ContactRule::gauss, triangle_degree);
  const double sense = signed_area(part) < 0.0 ? -1.0 : 1.0;
  std::vector<FacePoint> points;
  for (const auto& [i, j, k] : triangles_of(part.size())) {
    const Vector2d a = part[j] - part[i];
    const Vector2d b = part[k] - part[i];
    const double twice = sense * (a[0] * b[1] - a[1] * b[0]);
    for (const FacePoint& gauss : rule)
      points.push_back({part[i] + gauss.xi[0] * a + gauss.xi[1] * b, gauss.weight * twice});
  }
  return points;
}

/// What the corners of both have in common, in the slave's reference cell.
Polygon common_part(const FacetGeometry& slave, const FacetGeometry& master) {
  const Plane plane = plane_of(slave);
  const Polygon theirs = plane.outline(master);
  const Polygon ours = plane.outline(slave);
  if (misses(ours, theirs)) return {};
  if (plane.normal().dot(normal_at(master, facet_centre(master.type))) > -least_facing) return {};
  const Polygon common = clipped(theirs, ours);
  if (common.empty() || signed_area(common) <= sliver * signed_area(ours)) return {};
  const FacetGeometry straight = straight_edged(slave);
  Polygon part;
  for (const Vector2d& corner : common) {
    const auto at = plane.over(straight, corner);
    if (!at) return {};
    part.push_back(*at);
  }
  return about_mean(std::move(part));
}

FacetOverlap polygon_overlap(const FacetGeometry& slave, const FacetGeometry& master) {
  const Polygon part = common_part(slave, master);
  if (part.empty()) return {};
  Polygon faced;
  for (const Vector2d& corner : part) {
    const auto hit = met_on_surface(slave, master, corner);
    if (!hit) return {};
    faced.push_back(*hit);
  }
  FacetOverlap overlap;
  for (const FacePoint& at : part_rule(part)) {
    const auto hit = met_on_surface(slave, master, at.xi);
    if (!hit) return {};
    overlap.points.push_back({at.xi, *hit, at.weight});
  }
  overlap.master = part_rule(faced);
  return overlap;
}

}  // namespace

Vector3d point_at(const FacetGeometry& facet, const Vector2d& xi) {
  const FacetShape shape = facet_shape(facet.type, xi);
  Vector3d place = Vector3d::Zero();
  for (std::size_t i = 0; i < facet.points.size(); ++i) place += shape.values[i] * facet.points[i];
  return place;
}

Vector3d normal_at(const FacetGeometry& facet, const Vector2d& xi) {
  return facet_normal(facet.type, facet.points, xi);
}

FacetOverlap facet_overlap(const FacetGeometry& slave, const FacetGeometry& master) {
  const Near near_slave(slave, slave.points[0]);
  const Near near_master(master, slave.points[0]);
  return dimension(slave.type) == 1 ? segment_overlap(near_slave.geometry(), near_master.geometry())
                                    : polygon_overlap(near_slave.geometry(), near_master.geometry());
}

}  // namespace comma::solver
