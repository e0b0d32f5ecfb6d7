// The normals along which contact is measured.
#pragma once

#include <span>
#include <unordered_map>

#include <Eigen/Dense>

#include "solver/contact/definition.hpp"
#include "solver/contact/facet.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Current positions of the mesh's nodes.
using Positions = std::span<const Eigen::Vector3d>;

/// How the normals of a surface are found. `vector`: the outward normal where it is fixed, the direction that it is
/// across where it is along_y.
struct NormalChoice {
  NormalRule rule = NormalRule::automatic;
  std::array<double, 3> vector{};
};
inline NormalChoice master_choice(const ContactZone& zone) { return {zone.master_normal, zone.master_vector}; }
inline NormalChoice slave_choice(const ContactZone& zone) { return {zone.slave_normal, zone.slave_vector}; }

/// Whether a facet has a normal: a line in space has none by itself.
bool has_normal(const NormalChoice& choice, const Mesh& mesh, int facet);

/// Outward unit normal of a surface at a reference point of one of its facets (U4.44.11, VECT_MAIT, VECT_ESCL).
/// Throws Error `unsupported` for a line in space without a given normal, `degenerate-facet` for a null one.
Eigen::Vector3d surface_normal(const NormalChoice& choice, const Mesh& mesh, int facet, const Eigen::Vector2d& xi,
                               Positions positions);
/// From tangents, which a given normal does not need.
Eigen::Vector3d surface_normal(const NormalChoice& choice, const Mesh& mesh, int facet, const Tangents& tangents);

/// Outward unit normal of each node of the cells: the mean of the normals that the cells have there (U4.44.11,
/// NORMALE).
std::unordered_map<int, Eigen::Vector3d> nodal_normals(const Mesh& mesh, std::span<const int> cells,
                                                       Positions positions, const NormalChoice& choice = {});

/// Of a facet from the normals of its nodes (U4.44.11, LISSAGE): interpolated by the facet's shape functions, then made
/// unit.
Eigen::Vector3d interpolated_normal(const Mesh& mesh, int facet, const Eigen::Vector2d& xi,
                                    const std::unordered_map<int, Eigen::Vector3d>& normals);

/// The direction from master to slave: `side` picks the master's outward normal, the slave's turned round, or their
/// mean.
Eigen::Vector3d contact_normal(NormalSide side, const Eigen::Vector3d& master, const Eigen::Vector3d& slave);

}  // namespace comma::solver
