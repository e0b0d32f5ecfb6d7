// Which master facet each slave node faces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/definition.hpp"
#include "solver/contact/faced_facets.hpp"
#include "solver/contact/facet.hpp"
#include "solver/contact/normals.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

enum class PairingStatus : std::uint8_t {
  paired,
  watched,   ///< as if paired, in a zone where contact is not enforced
  excluded,  ///< by the user (SANS_GROUP_NO)
  too_far,   ///< no master node within the pairing distance (DIST_APPA)
  outside    ///< its projection falls outside the nearest facet by more than the tolerance (TOLE_PROJ_EXT)
};

/// A slave node and its place on the master surface.
struct ContactPair {
  int zone = 0;
  int slave = -1;
  PairingStatus status = PairingStatus::outside;
  int facet = -1;                                    ///< master cell, when paired
  std::array<double, max_facet_nodes> weights{};     ///< of the facet's nodes
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, from master to slave
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();    ///< the place on the facet
  /// Taken off the gap: of both sides (DIST_ESCL, DIST_MAIT), and what a curved facet rises above the corners that
  /// bear.
  double thickness = 0.0;
  bool kept = false;  ///< the facet is not the nearest, or no longer faced, but the one before (FacedFacet)
};

/// One entry a slave node and zone, zones in order, nodes rising: node-to-facet pairing (R5.03.50, section 3). A slave
/// node takes the facet whose nearest place is nearest (see FacetSearch::nearest); its orthogonal projection may fall
/// outside that facet by the tolerance, in reference coordinates, and is then brought back on its border, where the
/// normal is that of the mean of the tangents there and at the foot. The pairing distance is measured to the
/// nearest master node, as Code_Aster does: a node in the middle of a long facet is far from it. With PairingRule::node
/// it takes the nearest master node, and the mean of the normals there. `time`: at which thicknesses are read.
/// `before`: what slave nodes faced at the last pairing, if anything is to be kept of it.
std::vector<ContactPair> pair_surfaces(const ContactDefinition& definition, const Mesh& mesh, Positions positions,
                                       double time = 0.0, const FacedFacets& before = {});

/// What the nodes of these pairs face, to be kept within the margin when surfaces are paired again.
FacedFacets faced_facets(const std::vector<ContactPair>& pairs, double margin);

}  // namespace comma::solver
