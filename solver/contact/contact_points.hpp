// The integration points of the mixed formulation of contact, each facing a place on the master surface.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/definition.hpp"
#include "solver/contact/facet.hpp"
#include "solver/contact/pairing.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// What a gap takes of the position of a node.
struct GapShare {
  int node = -1;
  Eigen::Vector3d coefficient = Eigen::Vector3d::Zero();
};

/// A point of a slave face, or a patch of them (see patch_points.hpp). Pressures are interpolated from the face's nodes
/// by the same shape functions as displacements.
struct ContactPoint {
  int zone = 0;
  int cell = -1;        ///< slave face
  int node = -1;        ///< the slave node on which the point lies; -1: it lies between nodes
  int stands_for = -1;  ///< the slave node whose state it is: that one, or the one that a rule has it for
  std::array<double, max_facet_nodes> shape{};  ///< of the slave face's nodes
  double weight = 0.0;  ///< initial area (length in the plane; times the radius where axisymmetric)
  PairingStatus status = PairingStatus::outside;
  int facet = -1;             ///< master cell, when paired
  int beside = -1;            ///< the nearest master cell, when not paired
  bool faces_beside = false;  ///< its place lies on that cell: it is too far away alone, and counts as open in results
  std::array<double, max_facet_nodes> master_shape{};  ///< of the nodes of either
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, from master to slave
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();      ///< the place on the facet
  double thickness = 0.0;                              ///< of both sides, taken off the gap
  bool kept = false;                                   ///< see ContactPair
  /// Of a patch that faces the master: the mean gap is the sum of coefficient . position, less `offset`.
  std::vector<GapShare> shares;
  double offset = 0.0;         ///< see shares; thicknesses count in it
  bool bears_nothing = false;  ///< on the axis of an axisymmetric face, of second order, where no uniform pressure has
                               ///< a force at its node, or under a penalty, which has next to none
  double area = 0.0;  ///< of the patch's faces that face the master (of all, where none does), `weight` being that of
                      ///< the part that does
};

/// Zones in order, faces in order (R5.03.52). Points that share a node and a normal are one, with the sum of their
/// weights and the weighted mean of their faces' thicknesses, which is the same discrete problem. Excluded
/// nodes, and places between nodes that are nearest to excluded ones, have a point of PairingStatus::excluded that is
/// open, or none (see keeps_excluded_pressures()). In the discrete formulation the
/// points are the slave nodes that may make contact, of weight one: their tractions are forces. `time`: at which
/// thicknesses are read. Zones of local average contact have a point a patch. `before`: what each faced at the last
/// pairing, if anything is to be kept of it (averages over patches keep nothing). Throws what face_rule, projections
/// and normals throw.
std::vector<ContactPoint> contact_points(const ContactDefinition& definition, const Model& model, Positions positions,
                                         double time, const FacedFacets& before = {});

/// Whether nodes that are left out of a zone of the mixed formulation keep a pressure, which points left out bring to
/// zero. With INTEGRATION='AUTO' (Code_Aster 17.3, which refuses to leave nodes out with other rules).
bool keeps_excluded_pressures(const ContactZone& zone);

/// Whether the node on which a point lies is such a node; between nodes, whether all that are nearest to it are: those
/// that its shape functions weigh most.
bool is_nearest_to(const ContactPoint& point, const Mesh& mesh, const std::function<bool(int)>& is_such_node);

/// Of a facet as the mesh has it (see facet_stretch).
double initial_stretch(const Mesh& mesh, int facet, const Eigen::Vector2d& xi, bool times_radius);

}  // namespace comma::solver
