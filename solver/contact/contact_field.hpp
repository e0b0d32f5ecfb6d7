// CONT_NOEU: the state of contact at the slave nodes.
#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Dense>

#include "solver/contact/pairing.hpp"
#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// Contact at a slave node. `sticking`: friction holds it. Tangential forces of sliding are those of friction.
struct NodeContact {
  ContactPair pair;
  double gap = absent;
  double normal_force = 0.0;  ///< on the slave, positive in compression
  bool closed = false;        ///< whether contact holds it, be it by a pull (MixedZone::bilateral)
  bool has_foot = true;       ///< whether its place on the master is shown
  bool sticking = false;
  bool has_point = true;  ///< false: the node has forces alone, its shares of those between nodes
  Eigen::Vector3d shear_force = Eigen::Vector3d::Zero();  ///< on the slave
  Eigen::Vector2d slip = Eigen::Vector2d::Zero();         ///< along two tangents
};

/// What CONT says of a node that is not paired, or excluded: -1, or 0 in the discrete formulation (Code_Aster 17.3).
enum class Unpaired : std::int8_t { apart = -1, open = 0 };

/// Components (U2.04.04): CONT: -1 not paired (see Unpaired), or apart where contact is not enforced, 0 open, 1
/// sticking, 2 in contact and free to slide, 3 overlapping where contact is not enforced; JEU: gap, positive when open;
/// RN: size of the normal force, and RNX RNY RNZ the force on the master, as all forces here; the tangential ones of
/// sticking RTAX.. and of sliding RTGX..; RX RY RZ R: the whole force; I IX IY IZ: that times the `duration` of the
/// step; PT_X.. the slave node's place and PROJ_X.. its foot on the master surface, where the pair has one. GLIX GLIY
/// GLI: slip along two tangents and its size. HN is zero. Of a node that is not paired, or excluded, CONT is not zero,
/// nor JEU, PT_X.. and PROJ_X.. where a foot is shown; of one without a point of its own forces alone are not. A node
/// without a slave role carries nothing.
NodalField contact_field(std::span<const NodeContact> contacts, int node_count, Positions positions,
                         double duration = 0.0, Unpaired unpaired = Unpaired::apart);

/// The same without friction, in the discrete formulation. `gaps` and `multipliers`: one a pair (a length, a force); a
/// gap is not read where the node is not paired.
NodalField contact_field(std::span<const ContactPair> pairs, std::span<const double> gaps,
                         const Eigen::VectorXd& multipliers, int node_count, Positions positions,
                         double duration = 0.0);

/// Zero at slave nodes: that of the first step, whatever the surfaces are like then.
NodalField untouched_field(std::span<const int> slave_nodes, int node_count);

}  // namespace comma::solver
