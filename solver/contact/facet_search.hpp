// The place on a zone's master surface that a slave point faces.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/definition.hpp"
#include "solver/contact/faced_facets.hpp"
#include "solver/contact/normals.hpp"
#include "solver/contact/projection.hpp"
#include "solver/mesh/box_tree.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// What a slave point belongs to, which it cannot face: its node, or the nodes of the face in which it lies. Of the
/// latter facets count that look back at the face: the lips of a crack share nodes at its tip, and face each other.
struct OwnNodes {
  std::span<const int> nodes;
  int face = -1;  ///< in which the point lies between nodes; -1: it lies on a node
  /// The slave's unit normal at the point where gaps are measured along it: facets that do not oppose it are not faced.
  std::optional<Eigen::Vector3d> outward{};
};

/// Searches one zone on one geometry. Keeps references to its arguments.
class FacetSearch {
 public:
  /// `smooth`: normals are averaged at the nodes and interpolated between them (U4.44.11, LISSAGE).
  FacetSearch(const ContactZone& zone, bool smooth, const Mesh& mesh, Positions positions);
  /// Interpolates normals between the corners of QUAD8 faces alone (see straight_faces.hpp).
  void straighten_normals();

  struct Hit {
    int facet = -1;
    Projection projection;
    bool kept = false;  ///< another facet is nearer, or it is fallen outside of by more than the zone's tolerance (see
                        ///< FacedFacet)
    bool faces = true;  ///< false: the projection falls outside by more than the zone's tolerance
  };

  /// Whether no master node lies within the zone's pairing distance.
  bool too_far(const Eigen::Vector3d& point) const;

  /// The facet whose nearest place is nearest, of those around the nearest master node (Code_Aster 17.3, R5.03.50); of
  /// all where another one is not half as far, or the projection falls outside. Facets of the point's own nodes are
  /// passed over. Faces nothing where the orthogonal projection falls outside that facet by more than the zone's
  /// tolerance. Where the zone has a pairing direction: the nearest facet among those that a line along it meets, else
  /// the one that it passes by the closest. A facet that was faced before is kept within its margin, and facing any of
  /// them. Of facets that oppose the point's normal the nearest counts, if the point does not lie behind it, as behind
  /// the far side of a body; it may where it lies behind the nearest of all, and so in the body.
  std::optional<Hit> nearest(const Eigen::Vector3d& point, const OwnNodes& own, FacedFacet faced = {}) const;

  /// The nearest master node that is none of `own`, on one of its facets. Empty where there is none.
  std::optional<Hit> nearest_node(const Eigen::Vector3d& point, std::span<const int> own) const;

  /// Unit normal from master to slave at a hit. `slave_outward`: the slave's own unit normal, read where the zone asks
  /// for it.
  Eigen::Vector3d normal(const Hit& hit, const Eigen::Vector3d& slave_outward) const;

  /// Outward unit normal of a slave face at a reference point, smoothed as the zone asks.
  Eigen::Vector3d slave_normal(int cell, const Eigen::Vector2d& xi) const;
  /// The mean of the normals that the slave faces have at a node.
  Eigen::Vector3d slave_normal_at(int node) const { return slave_node_normals_.at(node); }

 private:
  std::unordered_map<int, std::vector<int>> facets_of_nodes() const;
  std::vector<Box> facet_boxes() const;
  std::vector<Box> node_boxes() const;
  std::optional<Projection> projected(const Eigen::Vector3d& point, CellType type,
                                      std::span<const Eigen::Vector3d> places) const;
  std::span<const Eigen::Vector3d> places_of(int facet, std::array<Eigen::Vector3d, max_facet_nodes>& points,
                                             Box& box) const;
  enum class Counted : std::uint8_t { all, opposing };
  /// The nearest facet, if it is nearer than `within`; else facet -1 at that distance.
  Hit nearest_facet(const Eigen::Vector3d& point, const OwnNodes& own, Counted counted, double within) const;
  Hit around_nearest_node(const Eigen::Vector3d& point, const OwnNodes& own) const;
  Hit nearest_counted(const Eigen::Vector3d& point, const OwnNodes& own) const;
  /// None of `own`; -1 where there is none.
  int nearest_master_node(const Eigen::Vector3d& point, std::span<const int> own) const;
  /// Of facet -1 where there is none.
  Hit nearest_faced(const Eigen::Vector3d& point, const OwnNodes& own) const;
  void consider(const Eigen::Vector3d& point, const OwnNodes& own, int facet, Counted counted, Hit& best) const;
  Eigen::Vector3d master_normal(const Hit& hit) const;
  bool opposes(const Hit& hit, const Eigen::Vector3d& slave_outward) const;
  bool is_in_front(const Eigen::Vector3d& point, const Hit& hit) const;
  std::optional<Hit> kept(const Eigen::Vector3d& point, FacedFacet faced, double least_distance) const;
  bool look_at_each_other(int face, int facet) const;
  bool is_outside(const Projection& projection, double margin) const;

  const ContactZone& zone_;
  const Mesh& mesh_;
  Positions positions_;
  std::vector<int> master_nodes_;
  std::unordered_map<int, std::vector<int>> facets_of_nodes_;  ///< of the master
  BoxTree facets_;
  BoxTree nodes_;
  std::unordered_map<int, Eigen::Vector3d> master_normals_;      ///< of the nodes; empty unless smoothed
  std::unordered_map<int, Eigen::Vector3d> slave_normals_;       ///< likewise
  std::unordered_map<int, Eigen::Vector3d> slave_node_normals_;  ///< where the slave has a say in normals
};

/// What a zone adds to both surfaces before a slave point, at a time (DIST_ESCL, DIST_MAIT), beside what the elements
/// there do. Both are functions of where the slave point is (Code_Aster 17.3).
double thickness_at(const ContactZone& zone, const Eigen::Vector3d& slave, double time);

}  // namespace comma::solver
