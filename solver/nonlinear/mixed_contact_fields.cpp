// What the mixed formulation adds to results: multipliers, CONT_NOEU, CONT_ELEM.
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>

#include "solver/contact/patch_field.hpp"
#include "solver/contact/patch_points.hpp"
#include "solver/contact/watched_zones.hpp"
#include "solver/mesh/slave_cut.hpp"
#include "solver/nonlinear/mixed_contact.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// A prescribed slip below this share of the largest displacement is none.
constexpr double least_prescribed_slip = 1e-9;

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

}  // namespace

void MixedContact::add_multipliers(const Eigen::VectorXd& u, NodalField& displacements) const {
  if (definition_.formulation == ContactFormulation::discrete) return;
  constexpr std::array<const char*, 3> names = {"LAGS_C", "LAGS_F1", "LAGS_F2"};
  const int added_components = definition_.has_friction ? rows_.dimension() : problem_.components;
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
  for (const ContactZone& zone : definition_.zones) {
    if (zone.mixed.local_average) continue;
    for (const int node : mesh_.nodes_of_cells(zone.slave_cells)) std::fill_n(place(node), added, 0.0);
  }
  for (const auto& [key, number] : rows_.multiplier_numbers()) std::fill_n(place(key.second), added, 0.0);
  for (const auto& [key, number] : rows_.multiplier_numbers()) {
    const Vector3d value = multiplier(number);
    const double limit = definition_.zones[static_cast<std::size_t>(key.first)].mixed.friction * value[0];
    place(key.second)[0] -= value[0];
    for (int c = 1; c < problem_.components && limit > 0.0; ++c) place(key.second)[c] += value[c] / limit;
  }
  show_pressures_on_axis(place);
  add_idle_multipliers(u, place);
  displacements.values = std::move(values);
}

/// Where the pressure of a node on the axis does not show in its force (bears_nothing), it is that of the face: the
/// parabola about the axis, a + b r^2, through the other two nodes. With a penalty nothing keeps the node from a little
/// gap between two that are pressed.
void MixedContact::show_pressures_on_axis(const std::function<double*(int)>& place) const {
  for (std::size_t p = 0; p < points().size(); ++p) {
    const ContactPoint& point = points()[p];
    if (!point.bears_nothing) continue;
    const auto nodes = mesh_.cell(point.cell);
    const double at_middle = place(nodes[2])[0], at_end = place(nodes[0] == point.node ? nodes[1] : nodes[0])[0];
    const bool closed = state_.statuses[p] != ContactStatus::open || (is_free_of_force(p) && at_end < 0.0);
    if (closed && at_middle < 0.0)
      place(point.node)[0] = (4.0 * at_middle - at_end) / 3.0;
    else if (is_free_of_force(p))
      place(point.node)[0] = 0.0;
  }
}

/// Shares of the limit where conditions prescribe how points slide.
void MixedContact::add_idle_multipliers(const Eigen::VectorXd& u, const std::function<double*(int)>& place) const {
  if (std::ranges::none_of(problem_.points, [](const CondensedPoint& point) { return point.idle_friction > 0.0; }))
    return;
  const Eigen::VectorXd now = jumps(u);
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    const double limit = point.idle_friction * (point.rows > 0 ? forces_[point.first_row] : 0.0);
    if (points()[p].node < 0 || !(limit > 0.0)) continue;
    const Eigen::VectorXd shear = shear_rows(p, now);
    for (Eigen::Index c = 0; c < shear.size(); ++c) place(points()[p].node)[c + 1] += shear[c] / limit;
  }
}

NodalField MixedContact::contact_state(const Eigen::VectorXd& u, Positions positions, double instant) const {
  const Eigen::VectorXd now = jumps(u);
  std::vector<NodeContact> contacts;
  std::map<Key, std::size_t> by_node;
  for (std::size_t p = 0; p < points().size(); ++p) {
    const ContactPoint& point = points()[p];
    const CondensedPoint& condensed = problem_.points[p];
    if (point.node < 0 || point.area > 0.0 || point.status == PairingStatus::watched) continue;
    NodeContact contact;
    contact.pair = {.zone = point.zone,
                    .slave = point.node,
                    .status = point.status,
                    .facet = point.facet,
                    .normal = point.normal,
                    .foot = point.foot};
    if (condensed.first_row >= 0) {
      contact.gap = now[condensed.first_row];
      contact.normal_force = forces_[condensed.first_row];
      contact.closed = point.status == PairingStatus::paired && state_.statuses[p] != ContactStatus::open;
      contact.sticking = state_.statuses[p] == ContactStatus::sticking;
    }
    if (problem_.components > 1 || definition_.has_friction) contact.slip.setZero();
    contact.shear_force = shear_force(p, now);
    for (int c = 1; c < condensed.rows; ++c)
      contact.slip[c - 1] = state_.statuses[p] == ContactStatus::open ? 0.0 : now[condensed.first_row + c];
    const auto [known, is_first] = by_node.emplace(Key(point.zone, point.node), contacts.size());
    if (is_first) {
      contacts.push_back(contact);
    } else if (contact.pair.status == PairingStatus::paired &&
               contacts[known->second].pair.status == PairingStatus::paired) {
      add_contact(contact, contacts[known->second]);
    } else if (contact.pair.status == PairingStatus::paired) {
      contacts[known->second] = contact;
    }
  }
  add_forces_between_nodes(now, by_node, contacts);
  add_nodes_without_contact(positions, instant, contacts);
  return contact_field(contacts, mesh_.node_count(), positions);
}

/// Where conditions prescribe how a point slides the law leaves friction out, and it is what Coulomb's law says against
/// that slip.
Eigen::VectorXd MixedContact::shear_rows(std::size_t p, const Eigen::VectorXd& jumps) const {
  const CondensedPoint& point = problem_.points[p];
  if (!(point.idle_friction > 0.0)) return forces_.segment(point.first_row + 1, point.rows - 1);
  const Eigen::VectorXd slip = jumps.segment(point.first_row + 1, point.rows - 1);
  const double size = slip.norm();
  const double limit = point.idle_friction * forces_[point.first_row];
  if (!(size > least_prescribed_slip * problem_.displacement) || !(limit > 0.0))
    return Eigen::VectorXd::Zero(point.rows - 1);
  return -limit * share_of_limit(point, size, limit) / size * slip;
}

/// Of the limit of friction: what a penalty brings by a slip of that size, a share a length in the mixed formulation
/// (see share_friction), a force a length in the discrete one.
double MixedContact::share_of_limit(const CondensedPoint& point, double slip, double limit) const {
  if (!point.law.friction_penalised) return 1.0;
  const double brought = point.law.friction_augmentation * slip;
  return std::min(1.0, definition_.formulation == ContactFormulation::mixed ? brought : point.weight * brought / limit);
}

Vector3d MixedContact::shear_force(std::size_t p, const Eigen::VectorXd& jumps) const {
  Vector3d force = Vector3d::Zero();
  if (problem_.points[p].rows < 2) return force;
  const Eigen::VectorXd rows = shear_rows(p, jumps);
  const ContactRows::Directions along = rows_.directions(points()[p]);
  for (Eigen::Index c = 0; c < rows.size(); ++c) force += rows[c] * along[static_cast<std::size_t>(c + 1)];
  return force;
}

/// Nodes bear their shares of what points between them do, so that all together bear the whole force. Those without a
/// point of their own do so in zones where others have one: a zone without points at nodes says nothing of them.
void MixedContact::add_forces_between_nodes(const Eigen::VectorXd& jumps, std::map<Key, std::size_t>& by_node,
                                            std::vector<NodeContact>& contacts) const {
  std::set<int> zones_with_nodes;
  for (const auto& [key, _] : by_node) zones_with_nodes.insert(key.first);
  for (std::size_t p = 0; p < points().size(); ++p) {
    const ContactPoint& point = points()[p];
    if (point.node >= 0 || point.area > 0.0 || problem_.points[p].first_row < 0 ||
        !zones_with_nodes.contains(point.zone))
      continue;
    const Vector3d normal = forces_[problem_.points[p].first_row] * point.normal, shear = shear_force(p, jumps);
    const auto nodes = mesh_.cell(point.cell);
    const bool sticks = state_.statuses[p] == ContactStatus::sticking;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto [known, is_first] = by_node.emplace(Key(point.zone, nodes[a]), contacts.size());
      if (is_first)
        contacts.push_back(
            {.pair = {.zone = point.zone, .slave = nodes[a], .status = PairingStatus::paired, .normal = point.normal},
             .sticking = true,
             .has_point = false});
      NodeContact& contact = contacts[known->second];
      if (!contact.has_point) contact.sticking &= sticks || state_.statuses[p] == ContactStatus::open;
      add_forces(point.shape[a] * normal, point.shape[a] * shear, contact);
    }
  }
}

/// Nodes of zones where contact is not enforced, and those that the user leaves out.
void MixedContact::add_nodes_without_contact(Positions positions, double instant,
                                             std::vector<NodeContact>& contacts) const {
  for (const auto& [index, pair] : watched_pairs(definition_, mesh_, positions, instant))
    contacts.push_back({.pair = pair, .gap = gap_at(pair, mesh_, positions)});
  for (std::size_t zone = 0; zone < definition_.zones.size(); ++zone) {
    const ContactZone& each = definition_.zones[zone];
    const std::set<int> excluded(each.excluded_slave_nodes.begin(), each.excluded_slave_nodes.end());
    if (excluded.empty()) continue;
    for (const int node : mesh_.nodes_of_cells(each.slave_cells))
      if (excluded.contains(node))
        contacts.push_back(
            {.pair = {.zone = static_cast<int>(zone), .slave = node, .status = PairingStatus::excluded}});
  }
}

std::optional<ElementField> MixedContact::patch_state(const Eigen::VectorXd& u) const {
  if (std::ranges::none_of(definition_.zones, [](const ContactZone& zone) { return zone.mixed.local_average; }))
    return std::nullopt;
  const Eigen::VectorXd now = jumps(u);
  std::map<int, PatchContact> by_node;  // a node inside tells the patch
  for (std::size_t p = 0; p < points().size(); ++p) {
    const ContactPoint& point = points()[p];
    if (!(point.area > 0.0)) continue;
    PatchContact& contact = by_node[point.node];
    contact.covered = point.weight / point.area;
    const CondensedPoint& condensed = problem_.points[p];
    if (condensed.first_row >= 0) contact.gap = now[condensed.first_row];
    if (condensed.rows == 0 || state_.statuses[p] == ContactStatus::open) continue;
    contact.is_closed = true;
    contact.pressure = multiplier(condensed.nodes[0])[0];
  }
  std::vector<std::pair<std::vector<int>, PatchContact>> patches;
  for (const auto& faces : mesh_.slave_patches) {
    const auto known = by_node.find(inner_nodes(mesh_, faces).front());
    if (known != by_node.end()) patches.emplace_back(faces, known->second);
  }
  return patch_field(patches, mesh_.cell_count());
}

}  // namespace comma::solver
