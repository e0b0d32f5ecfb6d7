// Friction where conditions on displacements hold both bodies along the surface.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/contact/contact_points.hpp"
#include "solver/contact_law/condensed_problem.hpp"

namespace comma::solver {

/// A traction along a direction in which both bodies are held (normal to a plane of symmetry) does nothing, and a shear
/// that is its part along the surface does no more than a pressure: the law of the point gets it as its dead one, also
/// where the surface lies askew. Where they are held in two directions, or in the plane in one that has a part along
/// the surface, friction moves nothing, and the law has none (CondensedPoint::idle_friction). `reduced_rows`: those of
/// the points, on the unknowns that conditions leave.
void find_dead_directions(const RowMatrix& reduced_rows, std::vector<CondensedPoint>& points);

/// Along what a point has no friction, because it lies on a node that has none there, or nearest to such nodes
/// (SANS_GROUP_NO_FR, DIRE_EXCL_FROT); zero: along none at all; null: it has friction all around.
std::optional<Eigen::Vector3d> excluded_direction(const MixedZone& zone, const ContactPoint& point, const Mesh& mesh);

/// The part of a direction along the surface, of length one, in the tangents. Throws Error `degenerate-facet` where it
/// is the normal of the face, which the message names.
Eigen::Vector2d along_tangents(const Eigen::Vector3d& direction, const Eigen::Vector3d& first,
                               const Eigen::Vector3d& second, const std::string& face);

}  // namespace comma::solver
