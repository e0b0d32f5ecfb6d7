// The foot of a node on a contact facet.
#pragma once

#include <optional>
#include <span>

#include <Eigen/Dense>

#include "solver/contact/facet.hpp"

namespace comma::solver {

struct Projection {
  Eigen::Vector2d xi;                             ///< on the facet (brought back)
  std::array<double, max_facet_nodes> weights{};  ///< shape functions there
  Eigen::Vector3d foot;                           ///< the point of the facet
  double distance = 0.0;                          ///< from the node to `foot`, >= 0
  double outside = 0.0;                           ///< how far outside the reference cell the orthogonal foot was
};

/// Orthogonal projection by Newton's method on the squared distance (R5.03.50, section 3), then brought back on the
/// facet. `points`: one a node of the facet. Empty where Newton does not converge, as it may on a facet that is so bent
/// or so far away that it has no foot.
std::optional<Projection> project(const Eigen::Vector3d& node, CellType type, std::span<const Eigen::Vector3d> points);

/// The place where a line through the node along `direction` meets the facet, brought back on the facet (U4.44.11,
/// TYPE_APPA='FIXE'). Empty where the line runs along the facet, or Newton does not converge.
std::optional<Projection> project_along(const Eigen::Vector3d& direction, const Eigen::Vector3d& node, CellType type,
                                        std::span<const Eigen::Vector3d> points);

}  // namespace comma::solver
