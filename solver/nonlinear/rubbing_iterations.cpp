// The part of MixedContact that goes by fixed points on contact while friction follows by Newton's method: what
// Code_Aster 17.3 does, iteration by iteration, so that figures of a criterion that is loose are the same.
#include <algorithm>
#include <utility>

#include "solver/linear/largest_component.hpp"
#include "solver/nonlinear/mixed_contact.hpp"

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Below it what friction changes by at the end is less than figures are compared by: Newton's method squares it.
constexpr double tight_friction = 1e-4;
/// A last change beyond this is told.
constexpr double coarse_friction = 1e-2;

}  // namespace

bool MixedContact::rubs_loosely() const {
  if (!(definition_.friction_tolerance > tight_friction)) return false;
  return std::ranges::all_of(definition_.zones, [](const ContactZone& zone) {
    const MixedZone& mixed = zone.mixed;
    return !zone.resolved || !(mixed.local_average || mixed.penalised || mixed.friction_penalised || mixed.bilateral);
  });
}

ContactLaw MixedContact::law_by_shares(std::size_t p, double pressure) const {
  ContactLaw law = problem_.points[p].law;
  if (!(law.friction > 0.0)) return law;
  const double by_slip = definition_.zones[static_cast<std::size_t>(points()[p].zone)].mixed.friction_augmentation;
  law.weighs_any_pressure = true;
  law.share_pressure = pressure;
  law.friction_augmentation = by_slip * law.friction * pressure;
  return law;
}

void MixedContact::begin_again() {
  rows_.visit_shears(problem_.components, [this](Index, Index shear, double) { state_.multipliers[shear] = 0.0; });
  rubbing_.last.resize(0);
  linearise_friction(reference_);
}

/// Shears are taken as they are at the largest pressure: shares of the limit that are as large as pressures are.
CondensedSolution MixedContact::step_by_shares() {
  const double largest = largest_component(state_.multipliers), unit = largest > 0.0 ? largest : 1.0;
  CondensedProblem problem = problem_;
  for (std::size_t p = 0; p < points().size(); ++p) problem.points[p].law = law_by_shares(p, unit);
  CondensedState state = state_;
  rows_.visit_shears(problem_.components, [&](Index pressure, Index shear, double) {
    const double present = state.multipliers[pressure];
    state.multipliers[shear] *= present != 0.0 ? unit / present : 0.0;
  });
  const CondensedSolution solution = solve_condensed(*schur_, problem, state);
  rows_.visit_shears(problem_.components, [&](Index pressure, Index shear, double) {
    state.multipliers[shear] *= state.multipliers[pressure] / unit;
  });
  state_.multipliers = std::move(state.multipliers);
  return solution;
}

int MixedContact::linearise_friction(const VectorXd& u) {
  const VectorXd now = jumps(u);
  const CondensedState by_shares{rows_.with_shares(state_.multipliers, problem_.components), {}};
  forces_.setZero(rows_.full().rows());
  int changes = 0;
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0 || state_.statuses[p] == ContactStatus::open) continue;
    const ContactLaw law = law_by_shares(p, 1.0);
    Vector3d multiplier = multiplier_at(problem_, by_shares, point);
    multiplier.tail<2>() *= law.friction;
    const Vector3d jump = at_point(point, now);
    const ContactStatus status = contact_status(law, true, multiplier, jump);
    changes += status != state_.statuses[p];
    state_.statuses[p] = status;
    forces_.segment(point.first_row, point.rows) =
        point.weight * contact_law(law, status, multiplier, jump).traction.head(point.rows);
  }
  note_friction(u, by_shares.multipliers);
  return changes;
}

/// Displacements and multipliers are measured alike, whatever their units.
void MixedContact::note_friction(const VectorXd& u, const VectorXd& shares) {
  VectorXd unknowns(u.size() + shares.size());
  unknowns << u - reference_, shares;
  if (rubbing_.last.size() == 0) rubbing_.last = VectorXd::Zero(unknowns.size());
  const double size = largest_component(unknowns);
  rubbing_.change = size > 0.0 ? largest_component(unknowns - rubbing_.last) / size : 0.0;
  rubbing_.last = std::move(unknowns);
}

void MixedContact::note_coarse_friction(ContactDoubts& doubts) const {
  if (!is_rubbing() || rubbing_.change <= coarse_friction) return;
  for (std::size_t p = 0; p < points().size(); ++p)
    if (state_.statuses[p] != ContactStatus::open && problem_.points[p].law.friction > 0.0)
      doubts.note({.kind = DoubtKind::coarse_friction,
                   .zone = points()[p].zone,
                   .share = rubbing_.change,
                   .penalty = definition_.friction_tolerance});
}

int MixedContact::change_points(const VectorXd& u) {
  const VectorXd now = jumps(u);
  int changes = 0;
  for (std::size_t p = 0; p < points().size(); ++p) {
    const CondensedPoint& point = problem_.points[p];
    if (point.rows == 0) continue;
    const bool closes = closing_pressure(point.law, multiplier_at(problem_, state_, point), at_point(point, now)) > 0.0;
    if (closes == (state_.statuses[p] != ContactStatus::open)) continue;
    state_.statuses[p] = closes ? ContactStatus::sticking : ContactStatus::open;
    ++changes;
  }
  return changes;
}

}  // namespace comma::solver
