// The normals along which contact is measured.
#pragma once

#include <span>
#include <unordered_map>

#include <Eigen/Dense>

#include "solver/contact/definition.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Current positions of the mesh's nodes.
using Positions = std::span<const Eigen::Vector3d>;

/// Outward unit normal of each node of the cells: the mean of the normals that the cells have there (U4.44.11, NORMALE).
std::unordered_map<int, Eigen::Vector3d> nodal_normals(const Mesh& mesh, std::span<const int> cells, Positions positions);

/// Outward unit normal of a facet at a reference point. Throws Error `unsupported` for a line in space, `degenerate-facet` for a
/// null one.
Eigen::Vector3d outward_normal(const Mesh& mesh, int facet, const Eigen::Vector2d& xi, Positions positions);

/// The same from the normals of its nodes (U4.44.11, LISSAGE): interpolated by the facet's shape functions, then made unit.
Eigen::Vector3d interpolated_normal(const Mesh& mesh, int facet, const Eigen::Vector2d& xi,
                                    const std::unordered_map<int, Eigen::Vector3d>& normals);

/// Outward unit normal of the master surface at a reference point of one of its facets, as the zone's rule says.
/// Throws Error `unsupported` for a line in space without a given normal, `degenerate-facet` for a null one.
Eigen::Vector3d master_normal(const ContactZone& zone, const Mesh& mesh, int facet, const Eigen::Vector2d& xi,
                              Positions positions);

/// The direction from master to slave: `side` picks the master's outward normal, the slave's turned round, or their mean.
Eigen::Vector3d contact_normal(NormalSide side, const Eigen::Vector3d& master, const Eigen::Vector3d& slave);

}  // namespace comma::solver
