#include "solver/contact_law/dead_directions.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "solver/error.hpp"

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
    const Eigen::MatrixXd squares = Eigen::MatrixXd(rows * rows.transpose());
    const double dead = dead_share * squares.trace();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> motions(squares);
    const Eigen::VectorXd along = motions.eigenvectors().col(0).tail(point.rows - 1);
    const bool shear_is_dead = motions.eigenvalues()[0] <= dead && along.norm() >= least_along;
    if (motions.eigenvalues()[1] <= dead || (point.rows == 2 && shear_is_dead))
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
  if (point.node < 0 && direction && std::ranges::any_of(mesh.cell(point.cell), is_left_out))
    throw Error(
        "unsupported",
        fmt::format("slave face {} has points between its nodes, and DIRE_EXCL_FROT is known of points at nodes",
                    mesh.cell_name(point.cell)),
        "take linear faces with INTEGRATION='AUTO', or leave DIRE_EXCL_FROT out: then these nodes have no friction at "
        "all");
  if (!is_nearest_to(point, mesh, is_left_out)) return {};
  return direction ? Eigen::Vector3d(direction->data()) : Eigen::Vector3d::Zero();
}

}  // namespace comma::solver
