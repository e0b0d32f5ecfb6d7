// CONT_NOEU: the state of contact at the slave nodes.
#pragma once

#include <span>

#include <Eigen/Dense>

#include "solver/contact/pairing.hpp"
#include "solver/fields/field.hpp"

namespace comma::solver {

/// Contact at a slave node. `sticking`: friction holds it. Tangential forces of sliding are those of friction.
struct NodeContact {
  ContactPair pair;
  double gap = absent;
  double normal_force = 0.0;  ///< positive in compression
  bool closed = false;        ///< whether contact holds it, be it by a pull (MixedZone::bilateral)
  bool sticking = false;
  bool has_point = true;  ///< false: the node has forces alone, its shares of those between nodes
  Eigen::Vector3d shear_force = Eigen::Vector3d::Zero();     ///< on the slave
  Eigen::Vector2d slip = Eigen::Vector2d::Constant(absent);  ///< along two tangents; absent without friction
};

/// Components (U2.04.04): CONT: -1 not paired, or apart where contact is not enforced, 0 open, 1 sticking, 2 in contact
/// and free to slide, 3 overlapping where contact is not enforced; JEU: gap, positive when open; RN: normal force on
/// the slave node, positive in compression, and its components RNX RNY RNZ; the tangential forces of sticking RTAX..
/// and of sliding RTGX.., zero without friction; RX RY RZ R: the whole force; PT_X.. the slave node's place and
/// PROJ_X.. its foot on the master surface. GLIX GLIY GLI: slip along two tangents and its size, with friction. What is
/// not computed here stays absent: HN, and the percussions I IX IY IZ (dynamics). A node that is not paired, or
/// excluded, has CONT and forces, which are zero; one without a point of its own has forces alone. A node without a
/// slave role carries nothing.
NodalField contact_field(std::span<const NodeContact> contacts, int node_count, Positions positions);

/// The same without friction. `gaps` and `multipliers`: one a pair (a length, a force); a gap is not read where the
/// node is not paired.
NodalField contact_field(std::span<const ContactPair> pairs, std::span<const double> gaps,
                         const Eigen::VectorXd& multipliers, int node_count, Positions positions);

}  // namespace comma::solver
