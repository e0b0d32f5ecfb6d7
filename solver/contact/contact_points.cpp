#include "solver/contact/contact_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>
#include <utility>

#include "solver/contact/face_rule.hpp"
#include "solver/contact/facet_search.hpp"
#include "solver/contact/half_thickness.hpp"
#include "solver/contact/patch_points.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// A shape function this near to one belongs to the node on which the point lies.
constexpr double at_node_tolerance = 1e-12;
/// Shape functions as near as this to the largest one weigh as much: the middle of a face is as near to all of its
/// sides.
constexpr double equal_weight = 1e-9;
/// Of the integral of a shape function, one below this share of that of its size hardly bears: it vanishes on straight
/// faces, and nearly so on curved ones.
constexpr double small_share = 0.1;
/// This share of it is next to nothing.
constexpr double least_share = 1e-9;
/// What Code_Aster 17.3 takes for a radius that vanishes, whatever the unit of length.
constexpr double radius_on_axis = 1e-7;

class ZonePoints {
 public:
  ZonePoints(const ContactDefinition& definition, int zone, const Model& model, Positions positions, double time,
             const FacedFacets& before)
      : zone_(definition.zones[static_cast<std::size_t>(zone)]),
        index_(zone),
        model_(model),
        mesh_(*model.mesh),
        positions_(positions),
        time_(time),
        before_(before),
        search_(zone_, definition.smooth_normals, mesh_, positions),
        excluded_(zone_.excluded_slave_nodes.begin(), zone_.excluded_slave_nodes.end()),
        merges_(zone_.normal_side == NormalSide::master || definition.smooth_normals || has_node_normals()) {}

  void append(int cell, std::vector<ContactPoint>& points) {
    const CellType type = mesh_.cell_types[cell];
    const std::vector<FacePoint> rule = face_rule(type, zone_.mixed.rule, zone_.mixed.rule_order);
    for (const FacePoint& at : rule) {
      ContactPoint point = place(cell, type, at);
      if (point.node >= 0 && point.weight == 0.0) {
        if (type == CellType::seg2 && zone_.mixed.penalised && has_node_normals())
          leave_without_force(point, at);
        else
          take_share(point, type, is_carried(cell, type, point.node, rule));
      }
      const bool excluded = is_nearest_to(point, mesh_, [&](int node) { return excluded_.contains(node); });
      if (point.weight == 0.0 || (excluded && !keeps_excluded_pressures(zone_))) continue;
      const auto known = merges_ && point.node >= 0 ? at_nodes_.find(point.node) : at_nodes_.end();
      if (known != at_nodes_.end()) {
        add(point, known->second, points[known->second.index]);
        continue;
      }
      face_master(at, before_.of(points.size()), point);
      if (excluded) leave_out(point);
      if (point.node >= 0) at_nodes_.emplace(point.node, AtNode{points.size(), half_thickness(zone_, cell)});
      points.push_back(point);
    }
  }

 private:
  struct AtNode {
    std::size_t index;      ///< of the point
    double half_thickness;  ///< of the slave faces around it, each by its weight
  };

  /// Faces of different thickness share the multiplier of the node, which sees the mean of their gaps.
  void add(const ContactPoint& further, AtNode& known, ContactPoint& point) const {
    const double weight = point.weight + further.weight;
    const double mean =
        (point.weight * known.half_thickness + further.weight * half_thickness(zone_, further.cell)) / weight;
    if (point.facet >= 0) point.thickness += mean - known.half_thickness;
    known.half_thickness = mean;
    point.weight = weight;
  }

  ContactPoint place(int cell, CellType type, const FacePoint& at) const {
    ContactPoint point;
    point.zone = index_;
    point.cell = cell;
    point.shape = facet_shape(type, at.xi).values;
    const auto nodes = mesh_.cell(cell);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (std::abs(point.shape[i] - 1.0) < at_node_tolerance) point.node = nodes[i];
    point.stands_for = at.stands_for < 0 ? point.node : nodes[static_cast<std::size_t>(at.stands_for)];
    point.weight = at.weight * measure(cell, at.xi);
    return point;
  }

  std::size_t local_number(int cell, int node) const {
    const auto nodes = mesh_.cell(cell);
    return static_cast<std::size_t>(std::ranges::find(nodes, node) - nodes.begin());
  }

  /// Whether other points of the face stand for the node.
  bool is_carried(int cell, CellType type, int node, const std::vector<FacePoint>& rule) const {
    const std::size_t local = local_number(cell, node);
    return std::ranges::any_of(rule, [&](const FacePoint& at) {
      return std::abs(facet_shape(type, at.xi).values[local]) > at_node_tolerance &&
             at.weight * measure(cell, at.xi) != 0.0;
    });
  }

  /// The integral of a node's shape function: what a point on the axis stands for, where the radius vanishes. On
  /// quadratic faces the integral vanishes too, or nearly so, yet the node may not overlap either: it weighs as much as
  /// its size. Next to nothing where other points carry the node, or an overlap has a pressure: the point shows how the
  /// node is.
  void take_share(ContactPoint& point, CellType type, bool carried) const {
    const std::size_t local = local_number(point.cell, point.node);
    double share = 0.0, size = 0.0;
    for (const FacePoint& at : face_rule(type, ContactRule::gauss, 0)) {
      const double part = at.weight * measure(point.cell, at.xi) * facet_shape(type, at.xi).values[local];
      share += part;
      size += std::abs(part);
    }
    point.bears_nothing = !carried && type == CellType::seg3 && share < small_share * size;
    point.weight = carried || (point.bears_nothing && zone_.mixed.penalised) ? least_share * size : size;
  }

  /// A penalty on the axis (Code_Aster 17.3): the weight is that of the rule, so that the node overlaps as it will.
  void leave_without_force(ContactPoint& point, const FacePoint& at) const {
    point.weight = at.weight * initial_stretch(mesh_, point.cell, at.xi, false) * radius_on_axis;
    point.bears_nothing = true;
  }

  Vector3d position(const ContactPoint& point) const {
    Vector3d at = Vector3d::Zero();
    const auto nodes = mesh_.cell(point.cell);
    for (std::size_t i = 0; i < nodes.size(); ++i) at += point.shape[i] * positions_[nodes[i]];
    return at;
  }

  /// Of the initial face: pressures are forces over the area before deformation.
  double measure(int cell, const Eigen::Vector2d& xi) const {
    return initial_stretch(mesh_, cell, xi, is_axisymmetric(model_.formulations[cell]));
  }

  void face_master(const FacePoint& at, FacedFacet before, ContactPoint& point) const {
    const Vector3d here = position(point);
    const bool is_too_far = search_.too_far(here);
    if (is_too_far) point.status = PairingStatus::too_far;
    OwnNodes own = own_nodes(point);
    if (zone_.normal_side != NormalSide::master)
      own.outward = has_node_normals() && point.stands_for >= 0 ? search_.slave_normal_at(point.stands_for)
                                                                : search_.slave_normal(point.cell, at.xi);
    const auto hit = search_.nearest(here, own, before);
    if (!hit) return;
    const bool faces = hit->faces && !is_too_far;
    if (faces) point.status = zone_.resolved ? PairingStatus::paired : PairingStatus::watched;
    (faces ? point.facet : point.beside) = hit->facet;
    point.faces_beside = hit->faces && !faces;
    point.master_shape = hit->projection.weights;
    point.foot = hit->projection.foot;
    point.kept = hit->kept;
    point.normal = search_.normal(*hit, own.outward.value_or(Vector3d::Zero()));
    point.thickness = thickness_at(zone_, here, time_) + half_thickness(zone_, point.cell);
  }

  /// It faces nothing, wherever it is.
  static void leave_out(ContactPoint& point) {
    point.status = PairingStatus::excluded;
    if (point.facet >= 0) point.beside = std::exchange(point.facet, -1);
    point.kept = false;
  }

  /// INTEGRATION='AUTO' is the discrete formulation's pairing of nodes (Code_Aster 17.3): the faces at a node have one
  /// normal there.
  bool has_node_normals() const { return zone_.mixed.rule == ContactRule::automatic; }

  /// A node of both surfaces cannot face the facets that it belongs to.
  OwnNodes own_nodes(const ContactPoint& point) const {
    if (point.node >= 0) return {std::span(&point.node, 1)};
    return {mesh_.cell(point.cell), point.cell};
  }

  const ContactZone& zone_;
  int index_;
  const Model& model_;
  const Mesh& mesh_;
  Positions positions_;
  double time_;
  const FacedFacets& before_;
  FacetSearch search_;
  std::unordered_set<int> excluded_;
  bool merges_;
  std::map<int, AtNode> at_nodes_;
};

/// Slave nodes as points of weight one, whose tractions are forces.
std::vector<ContactPoint> nodal_points(const ContactDefinition& definition, const Mesh& mesh, Positions positions,
                                       double time, const FacedFacets& before) {
  std::map<std::pair<int, int>, int> cells;  // of a zone's node: one of its slave faces
  for (std::size_t zone = 0; zone < definition.zones.size(); ++zone)
    for (const int cell : definition.zones[zone].slave_cells)
      for (const int node : mesh.cell(cell)) cells.emplace(std::pair(static_cast<int>(zone), node), cell);
  std::vector<ContactPoint> points;
  for (const ContactPair& pair : pair_surfaces(definition, mesh, positions, time, before)) {
    if (pair.status == PairingStatus::excluded) continue;
    ContactPoint point;
    point.zone = pair.zone;
    point.cell = cells.at({pair.zone, pair.slave});
    point.node = point.stands_for = pair.slave;
    const auto nodes = mesh.cell(point.cell);
    point.shape[static_cast<std::size_t>(std::ranges::find(nodes, pair.slave) - nodes.begin())] = 1.0;
    point.weight = 1.0;
    point.status = pair.status;
    point.facet = pair.facet;
    point.master_shape = pair.weights;
    point.normal = pair.normal;
    point.foot = pair.foot;
    point.kept = pair.kept;
    point.thickness = pair.thickness;
    points.push_back(point);
  }
  return points;
}

}  // namespace

double initial_stretch(const Mesh& mesh, int facet, const Eigen::Vector2d& xi, bool times_radius) {
  std::array<Vector3d, max_facet_nodes> points;
  const auto nodes = mesh.cell(facet);
  for (std::size_t i = 0; i < nodes.size(); ++i) points[i] = Vector3d(mesh.nodes[nodes[i]].data());
  return facet_stretch(mesh.cell_types[facet], {points.data(), nodes.size()}, xi, times_radius);
}

std::vector<ContactPoint> contact_points(const ContactDefinition& definition, const Model& model, Positions positions,
                                         double time, const FacedFacets& before) {
  if (definition.formulation == ContactFormulation::discrete)
    return nodal_points(definition, *model.mesh, positions, time, before);
  std::vector<ContactPoint> points;
  for (std::size_t zone = 0; zone < definition.zones.size(); ++zone) {
    if (definition.zones[zone].mixed.local_average) {
      append_patch_points(definition, static_cast<int>(zone), model, positions, time, points);
      continue;
    }
    ZonePoints builder(definition, static_cast<int>(zone), model, positions, time, before);
    for (const int cell : definition.zones[zone].slave_cells) builder.append(cell, points);
  }
  return points;
}

bool keeps_excluded_pressures(const ContactZone& zone) { return zone.mixed.rule == ContactRule::automatic; }

bool is_nearest_to(const ContactPoint& point, const Mesh& mesh, const std::function<bool(int)>& is_such_node) {
  if (point.node >= 0) return is_such_node(point.node);
  const auto nodes = mesh.cell(point.cell);
  const double most =
      *std::max_element(point.shape.begin(), point.shape.begin() + static_cast<std::ptrdiff_t>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (point.shape[i] >= most - equal_weight && !is_such_node(nodes[i])) return false;
  return true;
}

}  // namespace comma::solver
