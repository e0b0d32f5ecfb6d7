#include "solver/contact/pairing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "solver/contact/box_tree.hpp"
#include "solver/contact/projection.hpp"
#include "solver/contact/straight_faces.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// A curved facet bulges out of the box of its nodes by less than this share of the box's diagonal.
constexpr double bulge = 0.25;
/// Two facets whose distances differ by less than this share of the facet's size are equally near: the one that the
/// projection really hits wins, then the first.
constexpr double tie_tolerance = 1e-10;

class ZonePairing {
 public:
  ZonePairing(const ContactZone& zone, int index, const Mesh& mesh, Positions positions)
      : zone_(zone),
        index_(index),
        mesh_(mesh),
        positions_(positions),
        facets_(facet_boxes()),
        master_nodes_(mesh.nodes_of_cells(zone.master_cells)),
        nodes_(node_boxes()),
        excluded_(zone.excluded_slave_nodes.begin(), zone.excluded_slave_nodes.end()) {
    if (zone.normal_side != NormalSide::master) slave_normals_ = nodal_normals(mesh, zone.slave_cells, positions);
  }

  ContactPair pair(int slave) const {
    ContactPair result;
    result.zone = index_;
    result.slave = slave;
    result.status = status_before_search(slave);
    if (result.status != PairingStatus::outside) return result;
    const Candidate best = nearest_facet(slave);
    if (best.facet < 0 || is_outside(best.projection)) return result;
    result.status = zone_.resolved ? PairingStatus::paired : PairingStatus::watched;
    result.facet = best.facet;
    result.weights = best.projection.weights;
    result.foot = best.projection.foot;
    const Vector3d master = master_normal(zone_, mesh_, best.facet, best.projection.xi, positions_);
    const auto own = slave_normals_.find(slave);
    result.normal = contact_normal(zone_.normal_side, master, own == slave_normals_.end() ? Vector3d::Zero() : own->second);
    return result;
  }

 private:
  struct Candidate {
    int facet = -1;
    Projection projection;
  };

  std::vector<Box> facet_boxes() const {
    std::vector<Box> boxes;
    for (const int cell : zone_.master_cells) {
      Box box;
      for (const int node : mesh_.cell(cell)) box.extend(positions_[node]);
      const bool is_curved = node_count(mesh_.cell_types[cell]) > corner_count(mesh_.cell_types[cell]);
      const double margin = is_curved ? bulge * box.diagonal().norm() : 0.0;
      boxes.emplace_back(box.min().array() - margin, box.max().array() + margin);
    }
    return boxes;
  }

  std::vector<Box> node_boxes() const {
    std::vector<Box> boxes;
    for (const int node : master_nodes_) boxes.emplace_back(positions_[node], positions_[node]);
    return boxes;
  }

  PairingStatus status_before_search(int slave) const {
    if (excluded_.contains(slave)) return PairingStatus::excluded;
    if (zone_.pairing_distance < 0.0) return PairingStatus::outside;
    double nearest = std::numeric_limits<double>::infinity();
    nodes_.search(positions_[slave], [&](int item) {
      nearest = std::min(nearest, (positions_[master_nodes_[item]] - positions_[slave]).norm());
      return nearest;
    });
    return nearest > zone_.pairing_distance ? PairingStatus::too_far : PairingStatus::outside;
  }

  Candidate nearest_facet(int slave) const {
    Candidate best;
    best.projection.distance = std::numeric_limits<double>::infinity();
    facets_.search(positions_[slave], [&](int item) {
      consider(slave, zone_.master_cells[item], best);
      return best.projection.distance * (1.0 + tie_tolerance) + tie_tolerance;
    });
    return best;
  }

  void consider(int slave, int facet, Candidate& best) const {
    const auto cell = mesh_.cell(facet);
    if (std::find(cell.begin(), cell.end(), slave) != cell.end()) return;
    std::array<Vector3d, max_facet_nodes> points;
    Box box;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      points[i] = positions_[cell[i]];
      box.extend(points[i]);
    }
    const auto found = project(positions_[slave], mesh_.cell_types[facet], std::span(points.data(), cell.size()));
    if (!found) return;
    const double tie = tie_tolerance * box.diagonal().norm();
    const double gain = best.projection.distance - found->distance;
    const bool is_nearer = gain > tie;
    const bool is_better_hit = std::abs(gain) <= tie && (found->outside < best.projection.outside ||
                                                         (found->outside == best.projection.outside && facet < best.facet));
    if (is_nearer || is_better_hit) best = {facet, *found};
  }

  bool is_outside(const Projection& projection) const {
    // A negative tolerance admits only what falls inside; the margin is the accuracy of the projection itself.
    constexpr double accuracy = 1e-9;
    return projection.outside > std::max(0.0, zone_.projection_tolerance) + accuracy;
  }

  const ContactZone& zone_;
  int index_;
  const Mesh& mesh_;
  Positions positions_;
  BoxTree facets_;
  std::vector<int> master_nodes_;
  BoxTree nodes_;
  std::unordered_set<int> excluded_;
  std::unordered_map<int, Vector3d> slave_normals_;
};

}  // namespace

std::vector<ContactPair> pair_surfaces(const ContactDefinition& definition, const Mesh& mesh, Positions positions) {
  std::vector<ContactPair> pairs;
  for (std::size_t zone = 0; zone < definition.zones.size(); ++zone) {
    const ZonePairing pairing(definition.zones[zone], static_cast<int>(zone), mesh, positions);
    for (const int slave : contact_nodes(mesh, definition.zones[zone])) pairs.push_back(pairing.pair(slave));
  }
  return pairs;
}

}  // namespace comma::solver
