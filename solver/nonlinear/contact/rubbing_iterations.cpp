#include "solver/nonlinear/contact/rubbing_iterations.hpp"

#include <algorithm>
#include <utility>

#include "solver/linear/largest_component.hpp"

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

bool RubbingIterations::suit(const ContactDefinition& definition) {
  if (!(definition.friction_tolerance > tight_friction)) return false;
  return std::ranges::all_of(definition.zones, [](const ContactZone& zone) {
    const MixedZone& mixed = zone.mixed;
    return !zone.resolved || !(mixed.local_average || mixed.penalised || mixed.friction_penalised || mixed.bilateral);
  });
}

void RubbingIterations::forget() {
  last_.resize(0);
  solved_.resize(0);
  change_ = 0.0;
}

ContactLaw RubbingIterations::law_by_shares(std::size_t p, double pressure) const {
  ContactLaw law = contact_.problem.points[p].law;
  if (!(law.friction > 0.0)) return law;
  const double by_slip = contact_.mixed_zone_of(p).friction_augmentation;
  law.weighs_any_pressure = true;
  law.share_pressure = pressure;
  law.friction_augmentation = by_slip * law.friction * pressure;
  return law;
}

void RubbingIterations::begin_again() {
  contact_.rows.visit_shears(contact_.problem.components,
                             [this](Index, Index shear, double) { contact_.state.multipliers[shear] = 0.0; });
  last_.resize(0);
  linearise(contact_.reference);
}

/// Shears are taken as they are at the largest pressure: shares of the limit that are as large as pressures are.
CondensedSolution RubbingIterations::solve(SchurComplement& schur) {
  CondensedState& present = contact_.state;
  const double largest = largest_component(present.multipliers), unit = largest > 0.0 ? largest : 1.0;
  CondensedProblem problem = contact_.problem;
  for (std::size_t p = 0; p < problem.points.size(); ++p) problem.points[p].law = law_by_shares(p, unit);
  CondensedState state = present;
  contact_.rows.visit_shears(problem.components, [&](Index pressure, Index shear, double) {
    const double weight = state.multipliers[pressure];
    state.multipliers[shear] *= weight != 0.0 ? unit / weight : 0.0;
  });
  const CondensedSolution solution = solve_condensed(schur, problem, state);
  contact_.rows.visit_shears(problem.components, [&](Index pressure, Index shear, double) {
    state.multipliers[shear] *= state.multipliers[pressure] / unit;
  });
  present.multipliers = std::move(state.multipliers);
  return solution;
}

int RubbingIterations::linearise(const VectorXd& u) {
  const CondensedProblem& problem = contact_.problem;
  const VectorXd now = contact_.jumps(u);
  const CondensedState by_shares{contact_.rows.with_shares(contact_.state.multipliers, problem.components), {}};
  contact_.forces.setZero(contact_.rows.full().rows());
  int changes = 0;
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    const CondensedPoint& point = problem.points[p];
    if (point.rows == 0 || !contact_.is_closed(p)) continue;
    const ContactLaw law = law_by_shares(p, 1.0);
    Vector3d multiplier = multiplier_at(problem, by_shares, point);
    multiplier.tail<2>() *= law.friction;
    const Vector3d jump = at_point(point, now);
    const ContactStatus status = contact_status(law, true, multiplier, jump);
    changes += status != contact_.state.statuses[p];
    contact_.state.statuses[p] = status;
    contact_.forces.segment(point.first_row, point.rows) =
        point.weight * contact_law(law, status, multiplier, jump).traction.head(point.rows);
  }
  note_friction(u, by_shares.multipliers);
  return changes;
}

/// Displacements and multipliers are measured alike, whatever their units.
void RubbingIterations::note_friction(const VectorXd& u, const VectorXd& shares) {
  VectorXd unknowns(u.size() + shares.size());
  unknowns << u - contact_.reference, shares;
  if (last_.size() == 0) last_ = VectorXd::Zero(unknowns.size());
  const double size = largest_component(unknowns);
  change_ = size > 0.0 ? largest_component(unknowns - last_) / size : 0.0;
  last_ = std::move(unknowns);
}

void RubbingIterations::note_doubts(ContactDoubts& doubts) const {
  if (change_ <= coarse_friction) return;
  for (std::size_t p = 0; p < contact_.points().size(); ++p)
    if (contact_.is_closed(p) && contact_.problem.points[p].law.friction > 0.0)
      doubts.note({.kind = DoubtKind::coarse_friction,
                   .zone = contact_.points()[p].zone,
                   .share = change_,
                   .penalty = contact_.definition.friction_tolerance});
}

int RubbingIterations::change_points(const VectorXd& u) {
  const VectorXd now = contact_.jumps(u);
  int changes = 0;
  for (std::size_t p = 0; p < contact_.points().size(); ++p) {
    const CondensedPoint& point = contact_.problem.points[p];
    if (point.rows == 0) continue;
    const Vector3d multiplier = multiplier_at(contact_.problem, contact_.state, point);
    const bool closes = closing_pressure(point.law, multiplier, at_point(point, now)) > 0.0;
    if (closes == contact_.is_closed(p)) continue;
    contact_.state.statuses[p] = closes ? ContactStatus::sticking : ContactStatus::open;
    ++changes;
  }
  return changes;
}

}  // namespace comma::solver
