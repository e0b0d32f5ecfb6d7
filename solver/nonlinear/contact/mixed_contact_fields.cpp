#include "solver/nonlinear/contact/mixed_contact_fields.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "solver/contact/doubts.hpp"
#include "solver/contact/patch_field.hpp"
#include "solver/contact/patch_points.hpp"
#include "solver/contact/watched_zones.hpp"
#include "solver/mesh/slave_cut.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;
using Key = ContactRows::Key;

/// A prescribed slip below this share of the largest displacement is none.
constexpr double least_prescribed_slip = 1e-9;

/// In the mixed formulation a node slides from this share of the limit of friction on (LAGS_F1 and LAGS_F2), whatever
/// its points do (Code_Aster 17.3: 0.99909 slides, 0.99524 sticks, also where the augmentation brings it beyond one).
constexpr double sliding_share = 0.999;

void add_forces(const Vector3d& normal, const Vector3d& shear, NodeContact& sum) {
  const Vector3d whole = sum.normal_force * sum.pair.normal + normal;
  sum.shear_force += shear;
  sum.normal_force = whole.norm();
  if (sum.normal_force > 0.0) sum.pair.normal = whole / sum.normal_force;
}

/// Faces that share a slave node may each have a point there, with a normal of its own: the node bears what all of them
/// do.
void add_contact(const NodeContact& contact, NodeContact& sum) {
  sum.sticking = sum.closed && contact.closed ? sum.sticking && contact.sticking : sum.sticking || contact.sticking;
  sum.closed |= contact.closed;
  sum.gap = std::min(sum.gap, contact.gap);
  add_forces(contact.normal_force * contact.pair.normal, contact.shear_force, sum);
}

/// Of the limit of friction: what a penalty brings by a slip of that size, a share a length in the mixed formulation
/// (see share_friction), a force a length in the discrete one.
double share_of_limit(const SolvedContact& contact, const CondensedPoint& point, double slip, double limit) {
  if (!point.law.friction_penalised) return 1.0;
  const double brought = point.law.friction_augmentation * slip;
  return std::min(1.0, contact.faced.definition.formulation == ContactFormulation::mixed
                           ? brought
                           : point.weight * brought / limit);
}

/// Where conditions prescribe how a point slides the law leaves friction out, and it is what Coulomb's law says against
/// that slip, as far as there is friction along it.
Eigen::VectorXd shear_rows(const SolvedContact& contact, std::size_t p) {
  const CondensedPoint& point = contact.faced.problem.points[p];
  if (!(point.idle_friction > 0.0)) return contact.faced.forces.segment(point.first_row + 1, point.rows - 1);
  Vector3d jump = Vector3d::Zero();
  jump.head(point.rows) = contact.jumps.segment(point.first_row, point.rows);
  const Eigen::VectorXd slip = live_part(point.law, jump).segment(1, point.rows - 1);
  const double size = slip.norm();
  const double limit = point.idle_friction * contact.faced.forces[point.first_row];
  if (!(size > least_prescribed_slip * contact.faced.problem.displacement) || !(limit > 0.0))
    return Eigen::VectorXd::Zero(point.rows - 1);
  return -limit * share_of_limit(contact, point, size, limit) / size * slip;
}

Vector3d shear_force(const SolvedContact& contact, std::size_t p) {
  Vector3d force = Vector3d::Zero();
  if (contact.faced.problem.points[p].rows < 2) return force;
  const Eigen::VectorXd rows = shear_rows(contact, p);
  const ContactRows::Directions along = contact.faced.rows.directions(contact.faced.points()[p]);
  for (Eigen::Index c = 0; c < rows.size(); ++c) force += rows[c] * along[static_cast<std::size_t>(c + 1)];
  return force;
}

/// Where the pressure of a node on the axis does not show in its force (bears_nothing), it is that of the face: the
/// parabola about the axis, a + b r^2, through the other two nodes. With a penalty nothing keeps the node from a little
/// gap between two that are pressed. On faces of two nodes it is that of the penalty (Code_Aster 17.3).
void show_pressures_on_axis(const SolvedContact& contact, const std::function<double*(int)>& place) {
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
    const ContactPoint& point = contact.faced.points()[p];
    const auto nodes = contact.faced.mesh.cell(point.cell);
    if (!point.bears_nothing || nodes.size() < 3) continue;
    const double at_middle = place(nodes[2])[0], at_end = place(nodes[0] == point.node ? nodes[1] : nodes[0])[0];
    const bool closed = contact.faced.is_closed(p) || (contact.faced.is_free_of_force(p) && at_end < 0.0);
    if (closed && at_middle < 0.0)
      place(point.node)[0] = (4.0 * at_middle - at_end) / 3.0;
    else if (contact.faced.is_free_of_force(p))
      place(point.node)[0] = 0.0;
  }
}

/// Shares of the limit where conditions prescribe how points slide.
void add_idle_multipliers(const SolvedContact& contact, const std::function<double*(int)>& place) {
  if (std::ranges::none_of(contact.faced.problem.points,
                           [](const CondensedPoint& point) { return point.idle_friction > 0.0; }))
    return;
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
    const CondensedPoint& point = contact.faced.problem.points[p];
    const double limit = point.idle_friction * (point.rows > 0 ? contact.faced.forces[point.first_row] : 0.0);
    if (contact.faced.points()[p].node < 0 || !(limit > 0.0)) continue;
    const Eigen::VectorXd shear = shear_rows(contact, p);
    for (Eigen::Index c = 0; c < shear.size(); ++c) place(contact.faced.points()[p].node)[c + 1] += shear[c] / limit;
  }
}

/// Where a place on a cell has gone, by the shape functions of its nodes there.
Vector3d place_on_cell(const Mesh& mesh, int cell, std::span<const double> shape, Positions positions) {
  Vector3d place = Vector3d::Zero();
  const auto nodes = mesh.cell(cell);
  for (std::size_t a = 0; a < nodes.size(); ++a) place += shape[a] * positions[static_cast<std::size_t>(nodes[a])];
  return place;
}

/// Nodes of SANS_GROUP_NO_FR count as sticking whatever they do.
bool is_left_to_creep(const SolvedContact& contact, const ContactPoint& point) {
  const MixedZone& zone = contact.faced.definition.zones[static_cast<std::size_t>(point.zone)].mixed;
  return zone.rule == ContactRule::automatic && contact.faced.rows.leaves_out_all_directions(zone) &&
         std::ranges::find(zone.frictionless_nodes, point.node) != zone.frictionless_nodes.end();
}

/// `shares`: the multipliers as they are shown.
bool is_sticking(const SolvedContact& contact, std::size_t p, const Eigen::VectorXd& shares) {
  const ContactPoint& point = contact.faced.points()[p];
  const CondensedPoint& condensed = contact.faced.problem.points[p];
  if (contact.faced.definition.formulation == ContactFormulation::discrete || condensed.components < 2 ||
      condensed.idle_friction > 0.0)
    return contact.faced.state.statuses[p] == ContactStatus::sticking;
  const auto number = contact.faced.rows.multiplier_numbers().find(Key(point.zone, point.stands_for));
  const int components = contact.faced.problem.components;
  return number != contact.faced.rows.multiplier_numbers().end() &&
         shares.segment(number->second * components + 1, components - 1).norm() < sliding_share;
}

/// Of a point that stands for a node. One that does not lie on it leaves the forces to add_forces_between_nodes().
NodeContact node_contact(const SolvedContact& contact, Positions positions, std::size_t p,
                         const Eigen::VectorXd& shares) {
  const ContactPoint& point = contact.faced.points()[p];
  const CondensedPoint& condensed = contact.faced.problem.points[p];
  NodeContact node;
  node.pair = {.zone = point.zone,
               .slave = point.stands_for,
               .status = point.faces_beside ? PairingStatus::paired : point.status,
               .facet = point.facet >= 0 ? point.facet : point.beside,
               .weights = point.master_shape,
               .normal = point.normal,
               .foot = point.foot,
               .thickness = point.thickness};
  if (condensed.first_row >= 0) {
    node.gap = contact.jumps[condensed.first_row];
    if (point.node >= 0) node.normal_force = contact.faced.forces[condensed.first_row];
    node.closed = point.status == PairingStatus::paired && contact.faced.is_closed(p);
    node.sticking = node.closed && (is_sticking(contact, p, shares) || is_left_to_creep(contact, point));
  }
  const bool is_discrete = contact.faced.definition.formulation == ContactFormulation::discrete;
  node.has_foot = is_discrete ? node.closed : node.pair.facet >= 0;
  if (!is_discrete && node.has_foot) {
    const Mesh& mesh = contact.faced.mesh;
    node.pair.foot = place_on_cell(mesh, node.pair.facet, node.pair.weights, positions);
    const Vector3d place = point.node >= 0 ? positions[static_cast<std::size_t>(point.node)]
                                           : place_on_cell(mesh, point.cell, point.shape, positions);
    if (point.beside >= 0) node.gap = (place - node.pair.foot).dot(point.normal) - point.thickness;
  }
  if (point.node >= 0) node.shear_force = shear_force(contact, p);
  for (int c = 1; c < condensed.rows; ++c)
    node.slip[c - 1] = contact.faced.is_closed(p) ? contact.jumps[condensed.first_row + c] : 0.0;
  return node;
}

/// Of several faces whose points stand for a node the last one tells how it is (Code_Aster 17.3); its forces are those
/// of all points.
void show_state(const NodeContact& point, NodeContact& node) {
  const NodeContact before = std::exchange(node, point);
  node.normal_force = before.normal_force;
  node.shear_force = before.shear_force;
  if (before.normal_force > 0.0) node.pair.normal = before.pair.normal;
}

/// Nodes bear their shares of what points between them do, so that all together bear the whole force. Those without a
/// point of their own do so in zones where others have one: a zone without points at nodes says nothing of them.
void add_forces_between_nodes(const SolvedContact& contact, std::map<Key, std::size_t>& by_node,
                              std::vector<NodeContact>& contacts) {
  std::set<int> zones_with_nodes;
  for (const auto& [key, _] : by_node) zones_with_nodes.insert(key.first);
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
    const ContactPoint& point = contact.faced.points()[p];
    if (point.node >= 0 || point.area > 0.0 || contact.faced.problem.points[p].first_row < 0 ||
        !zones_with_nodes.contains(point.zone))
      continue;
    const Vector3d normal = contact.faced.forces[contact.faced.problem.points[p].first_row] * point.normal,
                   shear = shear_force(contact, p);
    const auto nodes = contact.faced.mesh.cell(point.cell);
    const bool sticks = contact.faced.state.statuses[p] == ContactStatus::sticking;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto [known, is_first] = by_node.emplace(Key(point.zone, nodes[a]), contacts.size());
      if (is_first)
        contacts.push_back(
            {.pair = {.zone = point.zone, .slave = nodes[a], .status = PairingStatus::paired, .normal = point.normal},
             .sticking = true,
             .has_point = false});
      NodeContact& node = contacts[known->second];
      if (!node.has_point) node.sticking &= sticks || !contact.faced.is_closed(p);
      add_forces(point.shape[a] * normal, point.shape[a] * shear, node);
    }
  }
}

/// Nodes of zones where contact is not enforced. In the mixed formulation they are open ones, whatever their gaps,
/// unless another zone holds them (Code_Aster 17.3).
void add_watched_nodes(const SolvedContact& contact, Positions positions, double instant,
                       std::vector<NodeContact>& contacts) {
  const bool mixed = contact.faced.definition.formulation == ContactFormulation::mixed;
  std::set<int> known;
  for (const NodeContact& each : contacts) known.insert(each.pair.slave);
  for (auto [index, pair] : watched_pairs(contact.faced.definition, contact.faced.mesh, positions, instant)) {
    if (mixed && known.contains(pair.slave)) continue;
    if (mixed) pair.status = PairingStatus::paired;
    contacts.push_back({.pair = pair, .gap = gap_at(pair, contact.faced.mesh, positions), .has_foot = !mixed});
  }
}

/// Those that the user leaves out.
void add_excluded_nodes(const SolvedContact& contact, std::vector<NodeContact>& contacts) {
  for (std::size_t zone = 0; zone < contact.faced.definition.zones.size(); ++zone) {
    const ContactZone& each = contact.faced.definition.zones[zone];
    const std::set<int> excluded(each.excluded_slave_nodes.begin(), each.excluded_slave_nodes.end());
    if (excluded.empty()) continue;
    for (const int node : contact.faced.mesh.nodes_of_cells(each.slave_cells))
      if (excluded.contains(node))
        contacts.push_back({.pair = {.zone = static_cast<int>(zone), .slave = node, .status = PairingStatus::excluded},
                            .has_foot = false});
  }
}

}  // namespace

void add_multipliers(const SolvedContact& contact, NodalField& displacements) {
  if (contact.faced.definition.formulation == ContactFormulation::discrete) return;
  constexpr std::array<const char*, 3> names = {"LAGS_C", "LAGS_F1", "LAGS_F2"};
  const int added_components =
      contact.faced.definition.has_friction ? contact.faced.rows.dimension() : contact.faced.problem.components;
  const auto added = static_cast<std::size_t>(added_components);
  const std::size_t before = displacements.components.size();
  const std::size_t all = before + added;
  const std::size_t nodes = displacements.values.size() / before;
  std::vector<double> values(nodes * all, absent);
  for (std::size_t node = 0; node < nodes; ++node)
    std::copy_n(displacements.values.begin() + static_cast<std::ptrdiff_t>(node * before), before,
                values.begin() + static_cast<std::ptrdiff_t>(node * all));
  displacements.components.insert(displacements.components.end(), names.begin(), names.begin() + added_components);
  const auto place = [&](int node) { return values.data() + static_cast<std::size_t>(node) * all + before; };
  for (const ContactZone& zone : contact.faced.definition.zones) {
    if (zone.mixed.local_average) continue;
    for (const int node : contact.faced.mesh.nodes_of_cells(zone.slave_cells)) std::fill_n(place(node), added, 0.0);
  }
  for (const auto& [key, number] : contact.faced.rows.multiplier_numbers()) std::fill_n(place(key.second), added, 0.0);
  const int components = contact.faced.problem.components;
  const Eigen::VectorXd shown = contact.faced.rows.with_shares(contact.faced.state.multipliers, components);
  for (const auto& [key, number] : contact.faced.rows.multiplier_numbers()) {
    place(key.second)[0] -= shown[number * components];
    for (int c = 1; c < components; ++c) place(key.second)[c] += shown[number * components + c];
  }
  show_pressures_on_axis(contact, place);
  add_idle_multipliers(contact, place);
  displacements.values = std::move(values);
}

std::optional<NodalField> contact_state(const SolvedContact& contact, Positions positions, Positions paired_at,
                                        double instant, double duration) {
  std::vector<NodeContact> contacts;
  std::map<Key, std::size_t> by_node;
  const Eigen::VectorXd shares =
      contact.faced.rows.with_shares(contact.faced.state.multipliers, contact.faced.problem.components);
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
    const ContactPoint& point = contact.faced.points()[p];
    if (point.stands_for < 0 || point.area > 0.0 || point.status == PairingStatus::watched) continue;
    const NodeContact node = node_contact(contact, positions, p, shares);
    const auto [known, is_first] = by_node.emplace(Key(point.zone, point.stands_for), contacts.size());
    if (is_first) {
      contacts.push_back(node);
    } else if (point.node < 0) {
      show_state(node, contacts[known->second]);
    } else if (node.pair.status == PairingStatus::paired &&
               contacts[known->second].pair.status == PairingStatus::paired) {
      add_contact(node, contacts[known->second]);
    } else if (node.pair.status == PairingStatus::paired) {
      contacts[known->second] = node;
    }
  }
  add_forces_between_nodes(contact, by_node, contacts);
  for (NodeContact& node : contacts)
    if (node.has_point && !node.closed) {
      node.normal_force = 0.0;
      node.shear_force.setZero();
    }
  const bool is_discrete = contact.faced.definition.formulation == ContactFormulation::discrete;
  add_watched_nodes(contact, is_discrete ? paired_at : positions, instant, contacts);
  add_excluded_nodes(contact, contacts);
  if (contacts.empty()) return std::nullopt;
  return contact_field(contacts, contact.faced.mesh.node_count(), positions, duration,
                       is_discrete ? Unpaired::open : Unpaired::apart);
}

std::optional<ElementField> patch_state(const SolvedContact& contact) {
  if (std::ranges::none_of(contact.faced.definition.zones,
                           [](const ContactZone& zone) { return zone.mixed.local_average; }))
    return std::nullopt;
  std::map<int, PatchContact> by_node;  // a node inside tells the patch
  for (std::size_t p = 0; p < contact.faced.points().size(); ++p) {
    const ContactPoint& point = contact.faced.points()[p];
    if (!(point.area > 0.0)) continue;
    PatchContact& patch = by_node[point.node];
    patch.covered = point.weight / point.area;
    const CondensedPoint& condensed = contact.faced.problem.points[p];
    if (condensed.first_row >= 0) patch.gap = contact.jumps[condensed.first_row];
    if (condensed.rows == 0 || !contact.faced.is_closed(p)) continue;
    patch.is_closed = true;
    patch.pressure = multiplier_at(contact.faced.problem, contact.faced.state, condensed)[0];
  }
  std::vector<std::pair<std::vector<int>, PatchContact>> patches;
  for (const auto& faces : contact.faced.mesh.slave_patches) {
    const auto known = by_node.find(inner_nodes(contact.faced.mesh, faces).front());
    if (known != by_node.end()) patches.emplace_back(faces, known->second);
  }
  return patch_field(patches, contact.faced.mesh.cell_count());
}

}  // namespace comma::solver
