#include "solver/nonlinear/contact/contact_penalties.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "solver/contact_law/nodal_step.hpp"

namespace comma::solver {

void ContactPenalties::start_step(bool closed) {
  opens_by_gaps_ = false;
  state_.adapted.start_step(closed);
}

void ContactPenalties::apply() {
  for (std::size_t p = 0; p < contact_.points().size(); ++p) {
    CondensedPoint& point = contact_.problem.points[p];
    const int zone = contact_.points()[p].zone;
    state_.raised.apply(contact_.mixed_zone_of(p), zone, point);
    if (adapts(static_cast<std::size_t>(zone))) point.law.augmentation = state_.adapted.penalty(p);
    point.law.opens_by_gap = opens_by_gaps_;
  }
}

bool ContactPenalties::exist() const {
  return std::ranges::any_of(contact_.definition.zones, [](const ContactZone& zone) { return zone.mixed.penalised; });
}

bool ContactPenalties::open_by_gaps() {
  if (opens_by_gaps_ || has_points_on_nodes(contact_.problem) || !exist()) return false;
  opens_by_gaps_ = true;
  apply();
  return true;
}

/// What friction gives way by is compared with the bodies where its limit is largest: by shares of the limit its
/// penalty is one over a length.
Excess ContactPenalties::excess_at(const Eigen::VectorXd& jumps) const {
  const std::size_t zones = contact_.definition.zones.size();
  Excess excess(zones);
  std::vector<double> of_bodies(zones, 0.0), of_friction(zones, 0.0);
  for (std::size_t p = 0; p < contact_.points().size(); ++p) {
    const CondensedPoint& point = contact_.problem.points[p];
    if (point.rows == 0 || contact_.is_free_of_force(p)) continue;
    const auto zone = static_cast<std::size_t>(contact_.points()[p].zone);
    const MixedZone& mixed = contact_.mixed_zone_of(p);
    const double stiffness = augmentations_.stiffness(p);
    of_bodies[zone] = std::max(of_bodies[zone], stiffness);
    if (const auto deepest = state_.raised.allowed_depth(); mixed.penalised && deepest)
      excess.depth[zone] = std::max(excess.depth[zone], -jumps[point.first_row] / *deepest);
    if (!mixed.friction_penalised || !contact_.is_closed(p)) continue;
    const double limit = point.law.friction * multiplier_at(contact_.problem, contact_.state, point)[0];
    of_friction[zone] =
        std::max(of_friction[zone], (point.share_augmentation > 0.0 ? limit : 1.0) * mixed.friction_penalty);
    if (mixed.largest_slip && contact_.state.statuses[p] == ContactStatus::sticking)
      excess.slip[zone] = std::max(excess.slip[zone], slip_of(point, jumps) / *mixed.largest_slip);
  }
  for (std::size_t zone = 0; zone < zones; ++zone) {
    const double of_contact = contact_.definition.zones[zone].mixed.augmentation;
    excess.soft_contact[zone] = std::max(1.0, of_bodies[zone] / of_contact);
    if (of_friction[zone] > 0.0) excess.soft_friction[zone] = std::max(1.0, of_bodies[zone] / of_friction[zone]);
  }
  return excess;
}

bool ContactPenalties::stiffen(const Eigen::VectorXd& u) {
  if (!state_.raised.raise(excess_at(contact_.jumps(u)))) return false;
  apply();
  return true;
}

bool ContactPenalties::adapts(std::size_t zone) const {
  return contact_.definition.zones[zone].mixed.adapts_penalty && !state_.raised.allowed_depth();
}

std::vector<double> ContactPenalties::depths(const Eigen::VectorXd& jumps) const {
  std::vector<double> result(contact_.points().size(), -std::numeric_limits<double>::infinity());
  for (std::size_t p = 0; p < result.size(); ++p)
    if (contact_.problem.points[p].rows > 0 && !contact_.is_free_of_force(p))
      result[p] = -jumps[contact_.problem.points[p].first_row];
  return result;
}

bool ContactPenalties::adapt(const Eigen::VectorXd& u, const std::function<Eigen::VectorXd()>& without_contact,
                             const std::function<double()>& stiffest) {
  std::vector<char> zones;
  for (std::size_t zone = 0; zone < contact_.definition.zones.size(); ++zone) zones.push_back(adapts(zone) ? 1 : 0);
  if (std::ranges::find(zones, 1) == zones.end()) return false;
  const std::vector<double> present = depths(contact_.jumps(u));
  const bool is_deep = state_.adapted.is_too_deep(zones, present);
  if (is_deep && !began_adapted())
    if (const Eigen::VectorXd gaps = without_contact(); gaps.size()) state_.adapted.note_depths(depths(gaps));
  const bool keeps_least = !contact_.definition.contact_by_newton;
  if (!state_.adapted.adapt(zones, present, is_deep ? stiffest() : 0.0, keeps_least)) return false;
  apply();
  return true;
}

}  // namespace comma::solver
