#include "solver/contact/pairing.hpp"

#include <optional>
#include <unordered_set>

#include "solver/contact/facet_search.hpp"
#include "solver/contact/half_thickness.hpp"
#include "solver/contact/straight_faces.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

class ZonePairing {
 public:
  ZonePairing(const ContactDefinition& definition, int index, const Mesh& mesh, Positions positions, double time)
      : zone_(definition.zones[static_cast<std::size_t>(index)]),
        index_(index),
        mesh_(mesh),
        takes_corners_(definition.formulation == ContactFormulation::discrete && zone_.resolved &&
                       has_straight_faces(mesh, zone_)),
        is_straight_(takes_corners_ && has_tied_edges(zone_)),
        straight_(is_straight_ ? straight_positions(mesh, zone_, positions) : std::vector<Vector3d>()),
        positions_(is_straight_ ? Positions(straight_) : positions),
        time_(time),
        search_(zone_, definition.smooth_normals || zone_.pairing == PairingRule::node, mesh, positions_),
        excluded_(zone_.excluded_slave_nodes.begin(), zone_.excluded_slave_nodes.end()) {
    if (is_straight_) search_.straighten_normals();
    slave_sizes_ = nodal_half_thickness(zone_, mesh);
  }

  ContactPair pair(int slave, FacedFacet before) const {
    ContactPair result;
    result.zone = index_;
    result.slave = slave;
    const Vector3d& at = positions_[slave];
    if (excluded_.contains(slave)) {
      result.status = PairingStatus::excluded;
    } else if (search_.too_far(at)) {
      result.status = PairingStatus::too_far;
    } else if (const auto hit = place_on_master(slave, before); hit && hit->faces) {
      result.status = zone_.resolved ? PairingStatus::paired : PairingStatus::watched;
      result.facet = hit->facet;
      result.weights = hit->projection.weights;
      result.foot = hit->projection.foot;
      result.kept = hit->kept;
      result.normal = search_.normal(*hit, outward_at(slave).value_or(Vector3d::Zero()));
      result.thickness = thickness_at(zone_, at, time_);
      if (const auto size = slave_sizes_.find(slave); size != slave_sizes_.end()) result.thickness += size->second;
      if (takes_corners_) bear_on_corners(result);
    }
    return result;
  }

 private:
  /// The corners of the facet alone bear; what a curved one rises above them counts as thickness.
  void bear_on_corners(ContactPair& pair) const {
    take_corners(mesh_.cell_types[static_cast<std::size_t>(pair.facet)], pair.weights);
    const auto nodes = mesh_.cell(pair.facet);
    Vector3d rise = pair.foot;
    for (std::size_t i = 0; i < nodes.size(); ++i) rise -= pair.weights[i] * positions_[nodes[i]];
    pair.thickness += pair.normal.dot(rise);
  }

  std::optional<FacetSearch::Hit> place_on_master(int slave, FacedFacet before) const {
    OwnNodes own{std::span(&slave, 1)};
    if (zone_.pairing == PairingRule::node) return search_.nearest_node(positions_[slave], own.nodes);
    own.outward = outward_at(slave);
    return search_.nearest(positions_[slave], own, before);
  }

  std::optional<Vector3d> outward_at(int slave) const {
    if (zone_.normal_side == NormalSide::master) return std::nullopt;
    return search_.slave_normal_at(slave);
  }

  const ContactZone& zone_;
  int index_;
  const Mesh& mesh_;
  bool takes_corners_;              ///< see straight_faces.hpp
  bool is_straight_;                ///< the same
  std::vector<Vector3d> straight_;  ///< where they are not where the mesh has them
  Positions positions_;
  double time_;
  FacetSearch search_;
  std::unordered_set<int> excluded_;
  std::unordered_map<int, double> slave_sizes_;  ///< of the nodes: what their elements add
};

}  // namespace

FacedFacets faced_facets(const std::vector<ContactPair>& pairs, double margin) {
  FacedFacets faced{{}, margin};
  for (const ContactPair& pair : pairs)
    if (pair.status != PairingStatus::excluded) faced.facets.push_back(pair.facet);
  return faced;
}

std::vector<ContactPair> pair_surfaces(const ContactDefinition& definition, const Mesh& mesh, Positions positions,
                                       double time, const FacedFacets& before) {
  std::vector<ContactPair> pairs;
  std::size_t asked = 0;
  for (std::size_t zone = 0; zone < definition.zones.size(); ++zone) {
    const ZonePairing pairing(definition, static_cast<int>(zone), mesh, positions, time);
    for (const int slave : contact_nodes(mesh, definition.zones[zone])) {
      pairs.push_back(pairing.pair(slave, before.of(asked)));
      if (pairs.back().status != PairingStatus::excluded) ++asked;
    }
  }
  return pairs;
}

}  // namespace comma::solver
