// Nodes that move together as a rigid body, and nodes that share a displacement.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>

#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Relations that leave the nodes no motion but u(M) = u(A) + rotation x AM, for small rotations (R3.03.02): in the
/// plane if none of them has DZ or rotations in space, else in space. Nodes that have rotations turn with the body.
/// Without any rotations, nodes that lie within `coincidence` of one line give no rotation about it, and nodes within
/// `coincidence` of one point share its displacement. One node gives no relation. Nodes may be given more than once.
/// Throws Error `unknown-dof` naming a node without degrees of freedom.
std::vector<LinearRelation> rigid_link(const Mesh& mesh, const DofMap& dofs, std::span<const int> nodes,
                                       double coincidence, const Origin& origin);

/// The same of nodes that lie at `places`, one for each of `nodes`: what they may do from there.
std::vector<LinearRelation> rigid_link(const Mesh& mesh, const DofMap& dofs, std::span<const int> nodes,
                                       std::span<const Eigen::Vector3d> places, double coincidence,
                                       const Origin& origin);

/// The distance below which nodes count as coincident unless told otherwise: a thousandth of the shortest edge of the
/// mesh (U4.44.01, LIAISON_SOLIDE/DIST_MIN). 0 in a mesh without edges.
double default_coincidence(const Mesh& mesh);

/// The same value of a component at all nodes: each less the first one is 0 (U4.44.01, LIAISON_UNIF).
std::vector<LinearRelation> uniform(std::span<const int> nodes, Component component, const Origin& origin);

}  // namespace comma::solver
