// The foot of a node on a contact facet.
#pragma once

#include <optional>
#include <span>

#include <Eigen/Dense>

#include "solver/contact/facet.hpp"

namespace comma::solver {

struct Projection {
  Eigen::Vector2d xi;                             ///< on the facet (brought back)
  Eigen::Vector2d from;                           ///< on the facet, where the last step to the foot began
  std::array<double, max_facet_nodes> weights{};  ///< shape functions at xi
  Eigen::Vector3d foot;                           ///< the point of the facet
  double distance = 0.0;                          ///< from the node to `foot`, >= 0
  double outside = 0.0;                           ///< how far outside the reference cell the orthogonal foot was
};

/// Orthogonal projection by Newton's method on the squared distance (R5.03.50, section 3), then brought back on the
/// facet. Iterations are Code_Aster's (17.3): they begin in the middle of the facet, take the step as it is, and end
/// with one that is a ten-thousandth of the place. Before the inner side of a steep arc they may end at a place that is
/// farthest: it counts, where none of the facet is nearest. Where they lead far away from the facet others do, which go
/// down from its middle. `points`: one a node of the facet. Empty where neither converge, as they may not on a facet
/// that is so bent or so far away that it has no foot.
std::optional<Projection> project(const Eigen::Vector3d& node, CellType type, std::span<const Eigen::Vector3d> points);

/// The same by iterations that go down from the middle of the facet, to rounding.
std::optional<Projection> project_exactly(const Eigen::Vector3d& node, CellType type,
                                          std::span<const Eigen::Vector3d> points);

/// The place where a line through the node along `direction` meets the facet, brought back on the facet (U4.44.11,
/// TYPE_APPA='FIXE'). Empty where the line runs along the facet, or Newton does not converge.
std::optional<Projection> project_along(const Eigen::Vector3d& direction, const Eigen::Vector3d& node, CellType type,
                                        std::span<const Eigen::Vector3d> points);

}  // namespace comma::solver
