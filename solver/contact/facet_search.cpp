#include "solver/contact/facet_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solver/contact/straight_faces.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// A curved facet bulges out of the box of its nodes by less than this share of the box's diagonal.
constexpr double bulge = 0.25;
/// Two facets whose distances differ by less than this share of coordinates, some roundings, are equally near: the
/// first of the mesh wins, as with Code_Aster. Beside a ridge, whose facets bring a point back to places next to each
/// other, more would pass over the nearest.
constexpr double tie_tolerance = 8 * std::numeric_limits<double>::epsilon();
/// Boxes this share farther than the nearest facet are looked into still: what is left out must not be as near.
constexpr double search_margin = 1e-10;
/// Nor is one of them nearer than another by less than this share, where the other looks at the point.
constexpr double equally_near = 1e-9;
/// A facet this much nearer than those around the nearest node is the one that the point comes to touch.
constexpr double much_nearer = 0.5;
/// Faces at right angles do not look at each other, whatever rounding says.
constexpr double least_opposition = 1e-6;
constexpr double infinitely_far = std::numeric_limits<double>::infinity();

bool share_a_node(std::span<const int> a, std::span<const int> b) {
  return std::ranges::any_of(a, [&](int node) { return std::ranges::find(b, node) != b.end(); });
}

bool is_curved(CellType type) { return node_count(type) > corner_count(type); }

}  // namespace

FacetSearch::FacetSearch(const ContactZone& zone, bool smooth, const Mesh& mesh, Positions positions)
    : zone_(zone),
      mesh_(mesh),
      positions_(positions),
      master_nodes_(mesh.nodes_of_cells(zone.master_cells)),
      facets_of_nodes_(facets_of_nodes()),
      facets_(facet_boxes()),
      nodes_(node_boxes()) {
  if (zone.normal_side != NormalSide::master)
    slave_node_normals_ = nodal_normals(mesh, zone.slave_cells, positions, slave_choice(zone));
  if (!smooth) return;
  slave_normals_ = slave_node_normals_;
  if (zone.master_normal == NormalRule::automatic && zone.normal_side != NormalSide::slave)
    master_normals_ = nodal_normals(mesh, zone.master_cells, positions);
}

void FacetSearch::straighten_normals() {
  if (!master_normals_.empty()) straighten(mesh_, zone_.master_cells, master_normals_);
  if (!slave_normals_.empty()) straighten(mesh_, zone_.slave_cells, slave_normals_);
}

std::unordered_map<int, std::vector<int>> FacetSearch::facets_of_nodes() const {
  std::unordered_map<int, std::vector<int>> facets;
  for (const int facet : zone_.master_cells)
    for (const int node : mesh_.cell(facet)) facets[node].push_back(facet);
  return facets;
}

std::vector<Box> FacetSearch::facet_boxes() const {
  std::vector<Box> boxes;
  for (const int cell : zone_.master_cells) {
    Box box;
    for (const int node : mesh_.cell(cell)) box.extend(positions_[node]);
    const double margin = is_curved(mesh_.cell_types[cell]) ? bulge * box.diagonal().norm() : 0.0;
    boxes.emplace_back(box.min().array() - margin, box.max().array() + margin);
  }
  return boxes;
}

std::vector<Box> FacetSearch::node_boxes() const {
  std::vector<Box> boxes;
  for (const int node : master_nodes_) boxes.emplace_back(positions_[node], positions_[node]);
  return boxes;
}

bool FacetSearch::too_far(const Vector3d& point) const {
  if (zone_.pairing_distance < 0.0) return false;
  double nearest = infinitely_far;
  nodes_.search(point, [&](int item) {
    nearest = std::min(nearest, (positions_[master_nodes_[item]] - point).norm());
    return nearest;
  });
  return nearest > zone_.pairing_distance;
}

FacetSearch::Hit FacetSearch::nearest_facet(const Vector3d& point, const OwnNodes& own, Counted counted,
                                            double within) const {
  Hit best;
  best.projection.distance = within;
  facets_.search(point, [&](int item) {
    consider(point, own, zone_.master_cells[item], counted, best);
    // Along a direction a facet that is far may be met where a near one is passed by.
    if (zone_.pairing_direction && (best.facet < 0 || best.projection.outside > 0.0)) return infinitely_far;
    return best.projection.distance * (1.0 + search_margin) + search_margin;
  });
  return best;
}

FacetSearch::Hit FacetSearch::around_nearest_node(const Vector3d& point, const OwnNodes& own) const {
  Hit best;
  best.projection.distance = infinitely_far;
  const int nearest = nearest_master_node(point, own.nodes);
  if (nearest < 0) return best;
  for (const int facet : facets_of_nodes_.at(nearest)) consider(point, own, facet, Counted::all, best);
  return best;
}

FacetSearch::Hit FacetSearch::nearest_counted(const Vector3d& point, const OwnNodes& own) const {
  if (zone_.pairing_direction) return nearest_facet(point, own, Counted::all, infinitely_far);
  const Hit around = around_nearest_node(point, own);
  const bool is_sound = around.facet >= 0 && !is_outside(around.projection, 0.0);
  const double within = is_sound ? much_nearer * around.projection.distance : infinitely_far;
  const Hit other = nearest_facet(point, own, Counted::all, within);
  return is_sound && !(other.projection.distance < within) ? around : other;
}

FacetSearch::Hit FacetSearch::nearest_faced(const Vector3d& point, const OwnNodes& own) const {
  const Hit nearest = nearest_counted(point, own);
  if (!own.outward || nearest.facet < 0 || opposes(nearest, *own.outward)) return nearest;
  const Hit opposing = nearest_facet(point, own, Counted::opposing, infinitely_far);
  const bool is_farther = opposing.projection.distance > nearest.projection.distance * (1.0 + equally_near);
  const bool lies_behind =
      opposing.facet >= 0 && is_farther && is_in_front(point, nearest) && !is_in_front(point, opposing);
  return lies_behind ? Hit{} : opposing;
}

std::optional<FacetSearch::Hit> FacetSearch::nearest(const Vector3d& point, const OwnNodes& own,
                                                     FacedFacet faced) const {
  Hit best = nearest_faced(point, own);
  if (faced.margin > 0.0 && faced.facet >= 0 && faced.facet != best.facet)
    if (auto before = kept(point, faced, best.facet < 0 ? infinitely_far : best.projection.distance)) return before;
  const double slack = faced.margin > 0.0 && faced.facet >= 0 ? faced.margin : 0.0;
  if (best.facet < 0) return std::nullopt;
  best.faces = !is_outside(best.projection, slack);
  best.kept = best.faces && is_outside(best.projection, 0.0);
  return best;
}

std::optional<FacetSearch::Hit> FacetSearch::kept(const Vector3d& point, FacedFacet faced,
                                                  double least_distance) const {
  std::array<Vector3d, max_facet_nodes> points;
  Box box;
  const auto places = places_of(faced.facet, points, box);
  const auto found = projected(point, mesh_.cell_types[faced.facet], places);
  if (!found || found->outside > faced.margin ||
      found->distance > least_distance + faced.margin * box.diagonal().norm())
    return std::nullopt;
  return Hit{faced.facet, *found, true};
}

std::span<const Vector3d> FacetSearch::places_of(int facet, std::array<Vector3d, max_facet_nodes>& points,
                                                 Box& box) const {
  const auto cell = mesh_.cell(facet);
  for (std::size_t i = 0; i < cell.size(); ++i) {
    points[i] = positions_[cell[i]];
    box.extend(points[i]);
  }
  return std::span<const Vector3d>(points.data(), cell.size());
}

int FacetSearch::nearest_master_node(const Vector3d& point, std::span<const int> own) const {
  int nearest = -1;
  double distance = infinitely_far;
  nodes_.search(point, [&](int item) {
    const int node = master_nodes_[item];
    const double away = (positions_[node] - point).norm();
    if (away < distance && std::ranges::find(own, node) == own.end()) {
      distance = away;
      nearest = node;
    }
    return distance;
  });
  return nearest;
}

std::optional<FacetSearch::Hit> FacetSearch::nearest_node(const Vector3d& point, std::span<const int> own) const {
  const int nearest = nearest_master_node(point, own);
  if (nearest < 0) return std::nullopt;
  Hit hit;
  hit.facet = facets_of_nodes_.at(nearest).front();
  const auto nodes = mesh_.cell(hit.facet);
  const auto local = static_cast<int>(std::ranges::find(nodes, nearest) - nodes.begin());
  hit.projection.xi = facet_node(mesh_.cell_types[hit.facet], local);
  hit.projection.from = hit.projection.xi;
  hit.projection.weights[static_cast<std::size_t>(local)] = 1.0;
  hit.projection.foot = positions_[nearest];
  hit.projection.distance = (positions_[nearest] - point).norm();
  return hit;
}

std::optional<Projection> FacetSearch::projected(const Vector3d& point, CellType type,
                                                 std::span<const Vector3d> places) const {
  if (!zone_.pairing_direction) return project(point, type, places);
  return project_along(Vector3d(zone_.pairing_direction->data()), point, type, places);
}

void FacetSearch::consider(const Vector3d& point, const OwnNodes& own, int facet, Counted counted, Hit& best) const {
  const auto cell = mesh_.cell(facet);
  if (share_a_node(own.nodes, cell) && !(own.face >= 0 && look_at_each_other(own.face, facet))) return;
  std::array<Vector3d, max_facet_nodes> points;
  Box box;
  const auto places = places_of(facet, points, box);
  const CellType type = mesh_.cell_types[facet];
  const double tie = tie_tolerance * std::max(point.cwiseAbs().maxCoeff(), box.diagonal().norm());
  // No place of a facet that does not bulge is nearer than its box.
  const bool may_be_passed_over = !zone_.pairing_direction && !is_curved(type);
  if (may_be_passed_over && box.exteriorDistance(point) > best.projection.distance + tie) return;
  const auto found = projected(point, type, places);
  if (!found || (counted == Counted::opposing && !opposes({facet, *found}, *own.outward))) return;
  if (zone_.pairing_direction && best.facet >= 0 && (found->outside > 0.0) != (best.projection.outside > 0.0)) {
    if (found->outside == 0.0) best = {facet, *found};
    return;
  }
  const double gain = best.projection.distance - found->distance;
  if (gain > tie || (gain >= -tie && facet < best.facet)) best = {facet, *found};
}

bool FacetSearch::look_at_each_other(int face, int facet) const {
  const auto normal_of = [&](int cell) {
    std::array<Vector3d, max_facet_nodes> points;
    Box box;
    const CellType type = mesh_.cell_types[cell];
    return facet_normal(type, places_of(cell, points, box), facet_centre(type));
  };
  return normal_of(face).dot(normal_of(facet)) < -least_opposition;
}

bool FacetSearch::is_outside(const Projection& projection, double margin) const {
  // A negative tolerance admits only what falls inside; the margin is the accuracy of the projection itself.
  constexpr double accuracy = 1e-9;
  return projection.outside > std::max(0.0, zone_.projection_tolerance) + margin + accuracy;
}

Vector3d FacetSearch::master_normal(const Hit& hit) const {
  if (!master_normals_.empty()) return interpolated_normal(mesh_, hit.facet, hit.projection.xi, master_normals_);
  // A given normal needs no tangents, which a point has not.
  if (zone_.master_normal == NormalRule::fixed)
    return surface_normal(master_choice(zone_), mesh_, hit.facet, Tangents::Zero());
  std::array<Vector3d, max_facet_nodes> points;
  Box box;
  const CellType type = mesh_.cell_types[hit.facet];
  const auto places = places_of(hit.facet, points, box);
  const Tangents mean =
      0.5 * (facet_tangents(type, places, hit.projection.from) + facet_tangents(type, places, hit.projection.xi));
  return surface_normal(master_choice(zone_), mesh_, hit.facet, mean);
}

bool FacetSearch::opposes(const Hit& hit, const Vector3d& slave_outward) const {
  return !has_normal(master_choice(zone_), mesh_, hit.facet) ||
         master_normal(hit).dot(slave_outward) < -least_opposition;
}

bool FacetSearch::is_in_front(const Vector3d& point, const Hit& hit) const {
  return master_normal(hit).dot(point - hit.projection.foot) >= 0.0;
}

Vector3d FacetSearch::normal(const Hit& hit, const Vector3d& slave_outward) const {
  if (zone_.normal_side == NormalSide::slave) return contact_normal(NormalSide::slave, Vector3d::Zero(), slave_outward);
  return contact_normal(zone_.normal_side, master_normal(hit), slave_outward);
}

double thickness_at(const ContactZone& zone, const Vector3d& slave, double time) {
  const auto value = [&](const FieldFunction& function) {
    return function ? function({slave[0], slave[1], slave[2]}, time) : 0.0;
  };
  return value(zone.slave_thickness) + value(zone.master_thickness);
}

Vector3d FacetSearch::slave_normal(int cell, const Eigen::Vector2d& xi) const {
  return slave_normals_.empty() ? surface_normal(slave_choice(zone_), mesh_, cell, xi, positions_)
                                : interpolated_normal(mesh_, cell, xi, slave_normals_);
}

}  // namespace comma::solver
