#include "solver/contact_law/dead_directions.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "solver/error.hpp"
#include "solver/unilateral/conditions.hpp"

namespace comma::solver {
namespace {

/// Of the squares of all rows of a point: what is less along a direction is the rounding of conditions.
constexpr double dead_share = 1e-14;
/// A traction that does nothing is one of shear if this share of it lies along the surface.
constexpr double least_along = 0.1;

}  // namespace

void find_dead_directions(const RowMatrix& reduced_rows, std::vector<CondensedPoint>& points) {
  for (CondensedPoint& point : points) {
    if (point.rows < 2 || !(point.law.friction > 0.0)) continue;
    const auto rows = reduced_rows.middleRows(point.first_row, point.rows);
    const Eigen::MatrixXd resisting = resisting_rows(point);
    const Eigen::MatrixXd squares = resisting * Eigen::MatrixXd(rows * rows.transpose()) * resisting.transpose();
    const double dead = dead_share * squares.trace();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> motions(squares);
    const Eigen::VectorXd along = motions.eigenvectors().col(0).tail(squares.rows() - 1);
    const bool shear_is_dead = motions.eigenvalues()[0] <= dead && along.norm() >= least_along;
    if (motions.eigenvalues()[1] <= dead || (squares.rows() == 2 && shear_is_dead))
      point.idle_friction = std::exchange(point.law.friction, 0.0);
    else if (shear_is_dead)
      point.law.dead = along.normalized();
  }
}

std::optional<Eigen::Vector3d> excluded_direction(const MixedZone& zone, const ContactPoint& point, const Mesh& mesh) {
  const auto& nodes = zone.frictionless_nodes;
  if (nodes.empty()) return {};
  const auto is_left_out = [&](int node) { return std::ranges::find(nodes, node) != nodes.end(); };
  const auto& direction = zone.frictionless_direction;
  if (!is_nearest_to(point, mesh, is_left_out)) return {};
  return direction ? Eigen::Vector3d(direction->data()) : Eigen::Vector3d::Zero();
}

Eigen::Vector2d along_tangents(const Eigen::Vector3d& direction, const Eigen::Vector3d& first,
                               const Eigen::Vector3d& second, const std::string& face) {
  const Eigen::Vector2d along(direction.dot(first), direction.dot(second));
  if (!(along.norm() > empty_row_tolerance * direction.norm()))
    throw Error("degenerate-facet", fmt::format("the direction without friction is the normal of slave face {}", face),
                "give a direction along the surface (DIRE_EXCL_FROT)");
  return along.normalized();
}

}  // namespace comma::solver
