// The part of MixedContact that goes on from step to step, and from an earlier computation, and remembers for a later
// one.
#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "solver/contact/extent.hpp"
#include "solver/nonlinear/mixed_contact.hpp"

namespace comma::solver {

/// Any would do for the next correction to start from; with a compliance that is not exact the nearest cost least.
void MixedContact::start_forces(double time) {
  CondensedState state = state_;
  if (problem_.components == 1 && !is_linear() && tangent_.is_constant() && schur_) {
    update_schur();
    if (!schur_->is_exact()) state.multipliers = course_.expected(time, state_.multipliers);
  }
  forces_ = multiplier_forces(problem_, state, rows_.full().rows());
}

void MixedContact::accept_step(double from, double instant) {
  rates_ = (state_.multipliers - start_) / (instant - from);
  course_.begin(from, start_);
  course_.note(instant, state_.multipliers);
  if (is_secant()) carry_contact();
}

void MixedContact::start_step(const Eigen::VectorXd& u, double duration) {
  secants_.predicts = is_secant();
  if (is_secant()) secants_.held = forces_;
  secants_.linearisations = 0;
  next_geometry_.reset();
  if (secants_.predicts && started_) begin_secants();
  reference_ = faced_at_ = u;
  step_begins_ = true;
  if (started_) {
    began_closed_ = closed_points();
    hold_points();
  }
  augmentation_share_ = 1.0;
  opens_by_gaps_ = false;
  adapted_.start_step(closed_count() > 0);
  apply_penalties();
  problem_.expected = state_.multipliers + duration * rates_;
  start_ = state_.multipliers;
  rows_.count_slips(problem_.points, reference_);
}

/// How zones are defined, without points.
std::vector<ZoneMemory> MixedContact::zone_definitions() const {
  std::vector<ZoneMemory> zones;
  for (const ContactZone& zone : definition_.zones) {
    const MixedZone& mixed = zone.mixed;
    std::vector<int> slave_cells = zone.slave_cells;
    std::ranges::sort(slave_cells);
    zones.push_back({mixed.bilateral,
                     {mixed.penalised ? mixed.augmentation : 0.0,
                      mixed.friction_penalised ? mixed.friction_penalty : 0.0, mixed.adapts_penalty ? 1.0 : 0.0,
                      mixed.largest_slip ? 1.0 : 0.0, definition_.formulation == ContactFormulation::mixed ? 1.0 : 0.0},
                     std::move(slave_cells)});
  }
  return zones;
}

std::shared_ptr<const ContactMemory> MixedContact::memory() const {
  const bool is_bilateral =
      std::ranges::any_of(definition_.zones, [](const ContactZone& zone) { return zone.mixed.bilateral; });
  if (!is_bilateral && !penalties_.are_raised()) return nullptr;
  std::vector<ZoneMemory> zones = zone_definitions();
  for (std::size_t p = 0; p < points().size() && is_bilateral; ++p)
    zones[static_cast<std::size_t>(points()[p].zone)].points.push_back(remembered(p));
  return std::make_shared<const ContactMemory>(ContactMemory{std::move(zones), penalties_});
}

void MixedContact::begin_at(const Eigen::VectorXd& u, std::shared_ptr<const ContactMemory> memory) {
  reference_ = u;
  if (!memory) return;
  const std::vector<ZoneMemory> now = zone_definitions();
  for (std::size_t zone = 0; zone < now.size(); ++zone) {
    const auto before = memory->zone_like(now[zone], zone);
    if (before && now[zone].penalties == memory->zones[*before].penalties)
      penalties_.go_on_from(memory->penalties, *before, zone);
  }
  resumed_ = std::move(memory);
}

RememberedPoint MixedContact::remembered(std::size_t p) const {
  return {points()[p].cell, initial_place(points()[p], mesh_), state_.statuses[p] != ContactStatus::open};
}

/// Which of the points the computation before left closed where they cannot open again.
std::vector<char> MixedContact::held_points() {
  std::vector<char> held(points().size(), 0);
  const auto memory = std::exchange(resumed_, nullptr);
  if (!memory) return held;
  const std::vector<ZoneMemory> zones = zone_definitions();
  for (std::size_t zone = 0; zone < zones.size(); ++zone) {
    if (!zones[zone].bilateral) continue;
    std::vector<std::size_t> own;
    std::vector<RememberedPoint> of_zone;
    std::vector<double> reach;
    for (std::size_t p = 0; p < points().size(); ++p) {
      if (points()[p].zone != static_cast<int>(zone)) continue;
      own.push_back(p);
      of_zone.push_back(remembered(p));
      reach.push_back(extent(mesh_, points()[p].cell));
    }
    const std::vector<char> was_held = memory->held(of_zone, zones[zone], reach);
    for (std::size_t k = 0; k < own.size(); ++k) held[own[k]] = was_held[k];
  }
  return held;
}

}  // namespace comma::solver
