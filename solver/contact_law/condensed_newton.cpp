#include "solver/contact_law/condensed_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/contact_law/relaxation.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// Gaps, pressures and shears beyond zero by less than this share of the largest are rounding: they change no status.
constexpr double status_tolerance = 1e-12;
/// Nor do pressures interpolated from larger ones of the nodes that push by so many of their roundings: beside a small
/// augmentation these are long gaps.
constexpr double pressure_roundings = 16.0;
/// The system is solved when what is left of it is this share of the jumps.
constexpr double residual_tolerance = 1e-12;
/// So many iterations may leave more than before, however little patience there is: on nodes, where sliding is
/// linearised such that they come back, some more.
constexpr int free_iterations = 2, free_iterations_on_nodes = 5;
/// A share of a correction has to bring what is left of the equations down by this much of itself.
constexpr double least_decrease = 1e-4;
/// It is halved down to this; corrections shorter than the other lead nowhere, and so many of them are the end.
constexpr double least_share = 1.0 / 128.0;
constexpr double shortest_useful_share = 1e-2;
constexpr int most_short_steps = 3;
/// Jumps that grow by more are those of a body that nothing holds any more.
constexpr double most_growth = 1e6;
/// States this many times as far as the nearest one that was met are those of bodies that have lost their contact: only
/// if there is no nearer one.
constexpr double farthest_state = 1e4;

}  // namespace

CondensedNewton::CondensedNewton(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state)
    : schur_(schur), problem_(problem), state_(state), equations_(schur, problem, state) {}

void CondensedNewton::go_to(const CondensedPlace& place) {
  state_ = place.state;
  equations_.go_to(place.jumps, place.forces);
}

void CondensedNewton::correct_once() {
  equations_.correct();
  equations_.evaluate();
}

void CondensedNewton::correct_statuses() {
  correct_once();
  if (std::isfinite(equations_.residual())) update_statuses();
}

bool CondensedNewton::stays_near() const {
  return equations_.scale() <= std::min(farthest_state * nearest_, problem_.farthest);
}

bool CondensedNewton::follow_smoothed(int& iterations, Augmentations augmentations) {
  if (problem_.components == 1) return false;
  Eigen::VectorXd jumps = equations_.jumps();
  std::vector<PointStiffness> bodies;
  const bool found = smooth_condensed(schur_, problem_, state_, jumps, bodies, augmentations);
  equations_.take_jumps(std::move(jumps));
  if (!found) return false;
  if (equations_.is_nodal())
    equations_.augment_pressures_and_shears(std::move(bodies));
  else if (augmentations == Augmentations::of_pressures)
    equations_.augment_shears(std::move(bodies));
  const bool solved = settle(Rubbing::by_law, iterations);
  equations_.augment_by_laws();
  return solved;
}

bool CondensedNewton::relax() {
  rubbing_ = Rubbing::by_law;
  Eigen::VectorXd jumps = equations_.jumps();
  const bool relaxed = relax_condensed(schur_, problem_, state_, jumps);
  equations_.take_jumps(std::move(jumps));
  return relaxed;
}

bool CondensedNewton::settle(Rubbing rubbing, int& iterations, Patience patience) {
  rubbing_ = rubbing;
  one_at_a_time_ = led_away_ = false;
  same_statuses_ = 0;
  last_residual_ = std::numeric_limits<double>::infinity();
  equations_.forget_loss();
  visited_.clear();
  double last = 0.0, before_last = 0.0;
  for (std::size_t p = 0; p < state_.statuses.size(); ++p)
    state_.statuses[p] = restricted(state_.statuses[p], problem_.points[p]);
  for (int iteration = 0; iteration < problem_.max_iterations; ++iteration) {
    ++iterations;
    correct_once();
    const double residual = equations_.residual();
    if (!std::isfinite(residual)) return false;
    nearest_ = std::min(nearest_, equations_.scale());
    const bool settled = !update_statuses();
    if (settled && is_solved()) return true;
    if (!settled) same_statuses_ = 0;
    if (problem_.components == 1) continue;
    if (one_at_a_time_) return false;  // with friction a cycle stays one
    if (rubbing_ != Rubbing::by_law) continue;
    led_away_ = patience == Patience::short_of_growth &&
                iteration >= (equations_.is_nodal() ? free_iterations_on_nodes : free_iterations) &&
                residual > before_last;
    if (led_away_) return false;
    before_last = last;
    // Where nothing is left with statuses that change, it says nothing of what will be.
    last = residual > residual_tolerance * equations_.scale() ? residual : std::numeric_limits<double>::infinity();
  }
  return false;
}

bool CondensedNewton::descend(int& iterations) {
  rubbing_ = Rubbing::by_law;
  led_away_ = false;
  equations_.forget_loss();
  equations_.take_balanced_jumps();
  adapt_statuses();
  const double farthest = most_growth * equations_.scale();
  int short_ones = 0;
  for (int iteration = 0; iteration < problem_.max_iterations && short_ones < most_short_steps; ++iteration) {
    ++iterations;
    const double before = equations_.remainder();
    if (correct_partly() < shortest_useful_share) ++short_ones;
    const double residual = equations_.residual();
    if (!std::isfinite(residual) || equations_.scale() > farthest) return false;
    if (residual <= residual_tolerance * equations_.scale()) return true;
    if (equations_.remainder() > 0.5 * before && equations_.is_rounding()) return true;
  }
  return false;
}

double CondensedNewton::correct_partly() {
  const CondensedState state = state_;
  const Eigen::VectorXd jumps = equations_.jumps();
  const double before = equations_.remainder();
  equations_.correct();
  const Eigen::VectorXd jump_step = equations_.jumps() - jumps,
                        multiplier_step = state_.multipliers - state.multipliers;
  for (double share = 1.0;; share *= 0.5) {
    equations_.take_jumps(jumps + share * jump_step);
    state_ = {state.multipliers + share * multiplier_step, state.statuses};
    equations_.evaluate();
    adapt_statuses();
    const double left = equations_.remainder();
    if (left < (1.0 - least_decrease * share) * before || share < least_share || !std::isfinite(left)) return share;
  }
}

void CondensedNewton::adapt_statuses() {
  visited_.clear();
  one_at_a_time_ = false;
  update_statuses();
  equations_.evaluate();
}

ContactStatus CondensedNewton::restricted(ContactStatus status, const CondensedPoint& point) const {
  if (status == ContactStatus::open || rubbing_ == Rubbing::by_law || !(point.law.friction > 0.0)) return status;
  return ContactStatus::sticking;
}

bool CondensedNewton::is_solved() {
  const double residual = equations_.residual();
  if (residual <= residual_tolerance * equations_.scale()) return true;
  const bool stagnates = same_statuses_ > 0 && residual > 0.5 * last_residual_;
  last_residual_ = residual;
  ++same_statuses_;
  return stagnates && equations_.is_rounding();
}

bool CondensedNewton::is_meant(std::size_t p, ContactStatus now, ContactStatus wanted) const {
  const CondensedPoint& point = problem_.points[p];
  const ContactLaw law = equations_.law_of(p);
  const Vector3d multiplier = equations_.multiplier_at(point);
  const Vector3d jump = equations_.jump_at(point);
  const double pressure = closing_pressure(law, multiplier, jump);
  if (now == ContactStatus::open)
    return pressure > law.augmentation * std::max(status_tolerance * equations_.scale(),
                                                  pressure_roundings * equations_.law_rounding(p)[0]);
  if (wanted == ContactStatus::open) return -pressure > status_tolerance * pressure_scale_;
  const double beyond = std::abs(shear_beyond_limit(law, multiplier, jump));
  return beyond > status_tolerance * problem_.points[p].law.friction * pressure_scale_;
}

ContactStatus CondensedNewton::wanted_status(std::size_t p) const {
  const CondensedPoint& point = problem_.points[p];
  const ContactStatus now = state_.statuses[p];
  if (point.rows == 0) return ContactStatus::open;
  const bool stays_closed = point.bilateral && now != ContactStatus::open;
  const ContactStatus wanted = restricted(
      contact_status(equations_.law_of(p), stays_closed, equations_.multiplier_at(point), equations_.jump_at(point)),
      point);
  return wanted == now || is_meant(p, now, wanted) ? wanted : now;
}

/// At nodes, where sliding is linearised such that iterations come nearer, statuses come back before all of them are
/// right: not a cycle while less is left than then.
bool CondensedNewton::is_cycle(const std::vector<ContactStatus>& next) {
  if (const auto now = visited_.find(state_.statuses); now != visited_.end()) now->second = equations_.residual();
  const auto [before, is_new] = visited_.try_emplace(next, 0.0);
  return !is_new && (!equations_.is_nodal() ||
                     std::max(equations_.residual(), residual_tolerance * equations_.scale()) > 0.5 * before->second);
}

bool CondensedNewton::update_statuses() {
  pressure_scale_ = equations_.largest_pressure();
  bool changed = false;
  std::vector<ContactStatus> next = state_.statuses;
  for (std::size_t p = 0; p < next.size() && !(changed && one_at_a_time_); ++p) {
    next[p] = wanted_status(p);
    changed |= next[p] != state_.statuses[p];
  }
  if (changed && is_cycle(next)) one_at_a_time_ = true;
  state_.statuses = std::move(next);
  return changed;
}

}  // namespace comma::solver
