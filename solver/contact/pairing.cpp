#include "solver/contact/pairing.hpp"

#include <unordered_set>

#include "solver/contact/facet_search.hpp"
#include "solver/contact/straight_faces.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

class ZonePairing {
 public:
  ZonePairing(const ContactDefinition& definition, int index, const Mesh& mesh, Positions positions, double time)
      : mesh_(mesh),
        zone_(definition.zones[static_cast<std::size_t>(index)]),
        index_(index),
        positions_(positions),
        time_(time),
        search_(zone_, definition.smooth_normals, mesh, positions),
        excluded_(zone_.excluded_slave_nodes.begin(), zone_.excluded_slave_nodes.end()) {
    if (zone_.normal_side != NormalSide::master) slave_normals_ = nodal_normals(mesh, zone_.slave_cells, positions);
    if (zone_.node_to_node) collect_master_nodes();
  }

  ContactPair pair(int slave) const {
    ContactPair result;
    result.zone = index_;
    result.slave = slave;
    const Vector3d& at = positions_[slave];
    if (excluded_.contains(slave)) {
      result.status = PairingStatus::excluded;
    } else if (search_.too_far(at)) {
      result.status = PairingStatus::too_far;
    } else if (zone_.node_to_node) {
      face_node(result);
    } else if (const auto hit = search_.nearest(at, std::span(&slave, 1))) {
      result.status = found();
      result.facet = hit->facet;
      result.weights = hit->projection.weights;
      result.foot = hit->projection.foot;
      result.normal = search_.normal(*hit, slave_normal(slave));
    }
    if (result.facet >= 0) result.thickness = thickness(zone_.slave_thickness, at) + thickness(zone_.master_thickness, result.foot);
    return result;
  }

 private:
  /// A node of the master surface as a place on one of its facets.
  struct MasterNode {
    int node, facet, corner;
  };

  PairingStatus found() const { return zone_.resolved ? PairingStatus::paired : PairingStatus::watched; }

  Vector3d slave_normal(int slave) const {
    const auto own = slave_normals_.find(slave);
    return own == slave_normals_.end() ? Vector3d::Zero() : own->second;
  }

  void collect_master_nodes() {
    std::unordered_set<int> known;
    for (const int cell : zone_.master_cells) {
      const auto nodes = mesh_.cell(cell);
      for (std::size_t corner = 0; corner < nodes.size(); ++corner)
        if (known.insert(nodes[corner]).second) master_nodes_.push_back({nodes[corner], cell, static_cast<int>(corner)});
    }
    master_normals_ = nodal_normals(mesh_, zone_.master_cells, positions_);
  }

  void face_node(ContactPair& pair) const {
    const Vector3d& at = positions_[pair.slave];
    const MasterNode* nearest = nullptr;
    for (const MasterNode& each : master_nodes_)
      if (each.node != pair.slave && (!nearest || (positions_[each.node] - at).squaredNorm() < (positions_[nearest->node] - at).squaredNorm()))
        nearest = &each;
    if (!nearest) return;
    pair.status = found();
    pair.facet = nearest->facet;
    pair.weights[static_cast<std::size_t>(nearest->corner)] = 1.0;
    pair.foot = positions_[nearest->node];
    const Vector3d master = zone_.master_normal == NormalRule::fixed
                                ? master_normal(zone_, mesh_, nearest->facet, Eigen::Vector2d::Zero(), positions_)
                                : master_normals_.at(nearest->node);
    pair.normal = contact_normal(zone_.normal_side, master, slave_normal(pair.slave));
  }

  double thickness(const FieldFunction& function, const Vector3d& at) const {
    return function ? function({at[0], at[1], at[2]}, time_) : 0.0;
  }

  const Mesh& mesh_;
  const ContactZone& zone_;
  int index_;
  Positions positions_;
  double time_;
  FacetSearch search_;
  std::unordered_set<int> excluded_;
  std::unordered_map<int, Vector3d> slave_normals_;
  std::vector<MasterNode> master_nodes_;  ///< of a zone that pairs nodes
  std::unordered_map<int, Vector3d> master_normals_;
};

}  // namespace

std::vector<ContactPair> pair_surfaces(const ContactDefinition& definition, const Mesh& mesh, Positions positions, double time) {
  std::vector<ContactPair> pairs;
  for (std::size_t zone = 0; zone < definition.zones.size(); ++zone) {
    const ZonePairing pairing(definition, static_cast<int>(zone), mesh, positions, time);
    for (const int slave : contact_nodes(mesh, definition.zones[zone])) pairs.push_back(pairing.pair(slave));
  }
  return pairs;
}

}  // namespace comma::solver
