// The part of StaticRun that solves one step: loads, contact as the geometry becomes, balance.
#include <algorithm>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/nonlinear/contact/geometry_updates.hpp"
#include "solver/nonlinear/failure.hpp"
#include "solver/nonlinear/iterations/known_displacements.hpp"
#include "solver/nonlinear/steps/static_run.hpp"
#include "solver/on_exit.hpp"

namespace comma::solver {
namespace {

using Eigen::Vector3d;

/// Those that settle do so geometrically, most of them in ten; others go round in circles.
constexpr int most_adaptations = 100;
/// Fixed points on contact in a geometry (the default of ITER_CONT_MAXI).
constexpr int most_fixed_points = 30;
/// In the first geometry of a step. The first of them may leave friction out, which there is none of before anything
/// presses: Code_Aster 17.3 goes on from it in any case.
constexpr int least_fixed_points = 2;

}  // namespace

int StaticRun::solve_step(double time) {
  assembler_.set_time(time);
  assembler_.impose_strains(problem_.loads, time);
  followers_.set_time(time);
  newton_.start_step(time - last_instant_);
  if (path_) {
    start_ = now_.state.u;
    return path_->solve(time, time - last_instant_, driven_loads(time), !may_cut_, now_.state.reduced, now_.state.u);
  }
  const Eigen::VectorXd external = assembler_.external_forces(problem_.loads, time);
  if (!links_.empty()) turn_links(last_instant_, now_.state);
  const Eigen::VectorXd offset = elimination_.offset(time);
  const bool updates = problem_.contact && problem_.contact->geometry_update != GeometryUpdate::none;
  if (mixed_) mixed_->start_step(now_.state.u, time - last_instant_);
  start_ = now_.state.u;
  guess(time);
  const bool is_weak = problem_.contact && problem_.contact->formulation == ContactFormulation::mixed;
  if (options_.extrapolates_flow) {
    now_.conditions = make_conditions({}, {}, mesh_, dofs_, time);
    return solve_extrapolated(time, external, offset);
  }
  int iterations = 0;
  std::optional<GeometryUpdates> geometry;
  if (updates) geometry.emplace(*problem_.contact, mesh_, dofs_, start_);
  for (int update = 0;; ++update) {
    if (updates || !now_.paired || (update == 0 && (pairs_each_step() || thickness_changes())))
      pair(time, update == 0 ? start_ : now_.state.u, geometry ? &*geometry : nullptr);
    ConditionSet next = make_conditions(now_.pairs, problem_.unilateral, mesh_, dofs_, time);
    const bool is_other = update == 0 || mixed_ || !same_rows(next, now_.conditions);
    if (is_other) resize_multipliers(next);
    now_.conditions = std::move(next);
    if (is_other) {
      // Between updates of the geometry the discrete formulation goes on counting, the mixed one begins again
      // (ssnv504f, ssnv504j).
      const int earlier = is_weak ? 0 : iterations;
      const auto balance = [&] {
        return newton_.solve(time, external, offset, now_.conditions, earlier, active_set_limit(), now_.state);
      };
      if (update > 0) adapt_penalties_once();
      iterations = earlier + (mixed_ && mixed_->is_rubbing()
                                  ? balance_by_fixed_points(time, update == 0 ? least_fixed_points : 1, balance)
                                  : balance());
      if (update == 0 && mixed_ && mixed_->penalties().began_adapted() && adapt_penalties_once())
        iterations += balance();
      for (int adaptations = 0; penalties_change(time, adaptations); ++adaptations) iterations += balance();
    }
    const bool at_rest = !geometry || geometry->settled(now_.reference, now_.state.u);
    const bool settled = at_rest || (mixed_ && mixed_->is_joint());
    if (settled && !(mixed_ && mixed_->leaves_overlap(now_.state.u))) {
      if (geometry) geometry->note_doubts(now_.pairs, mixed_ ? mixed_->points() : std::vector<ContactPoint>(), doubts_);
      return iterations;
    }
    if (!geometry) continue;
    geometry->note_cycle(now_.pairs);
    geometry->require_more(time);
  }
}

int StaticRun::balance_by_fixed_points(double time, int least, const std::function<int()>& balance) {
  int iterations = 0;
  for (int count = 1; count <= most_fixed_points; ++count) {
    now_.state.u = start_;
    now_.state.reduced = start_(elimination_.kept());
    mixed_->begin_again();
    iterations += balance();
    if (mixed_->change_points(now_.state.u) == 0 && count >= least) return iterations;
  }
  throw Error(
      "contact-cycling",
      fmt::format("contact has not settled after {} fixed points, in the step to t = {:.6g}", most_fixed_points, time),
      "find contact states by Newton's method (ALGO_RESO_CONT='NEWTON')");
}

bool StaticRun::adapt_penalties_once() {
  return mixed_ && !problem_.contact->contact_by_newton && mixed_->adapt_penalties(now_.state.u);
}

bool StaticRun::penalties_change(double time, int adaptations) {
  if (!mixed_) return false;
  if (mixed_->stiffen_penalties(now_.state.u)) {
    if (observer_)
      observer_(event_of_step(time, "contact is deeper, or slips by more, than allowed: its penalty is raised"));
    return true;
  }
  if (!problem_.contact->contact_by_newton || !mixed_->adapt_penalties(now_.state.u)) return false;
  if (adaptations < most_adaptations) return true;
  throw Error("no-convergence",
              fmt::format("penalties of contact that depths adapt have not settled after {} times", most_adaptations),
              "allow another depth (PENE_MAXI), or give the penalty (COEF_PENA_CONT with ADAPTATION='NON')");
}

int StaticRun::solve_extrapolated(double time, const Eigen::VectorXd& external, const Eigen::VectorXd& offset) {
  const OnExit as_they_are([&] { assembler_.extrapolate(std::nullopt); });
  assembler_.extrapolate(last_duration_ > 0.0 ? (time - last_instant_) / last_duration_ : 0.0);
  return newton_.solve(time, external, offset, now_.conditions, 0, 0, now_.state);
}

DrivenLoads StaticRun::driven_loads(double time) {
  DrivenLoads loads;
  loads.fixed = assembler_.external_forces(problem_.loads, time);
  // With the pressure as an unknown no strains are known but those that do not depend on the intensity: others are
  // refused.
  assembler_.impose_strains({}, time);
  loads.driven = assembler_.external_forces(problem_.driven, time);
  assembler_.impose_strains(problem_.loads, time);
  drive_ = 0.0;
  loads.fixed_offset = elimination_.offset(time);
  drive_ = 1.0;
  loads.driven_offset = elimination_.offset(time) - loads.fixed_offset;
  return loads;
}

void StaticRun::guess(double time) {
  Eigen::VectorXd u = now_.state.u;
  if (options_.guessed)
    u = displacements_at(time, *options_.guessed, dofs_, now_.state.u);
  else if (options_.guess == StepGuess::extrapolate && speed_.size() == u.size())
    u += (time - last_instant_) * speed_;
  else
    return;
  now_.state.reduced = u(elimination_.kept());
  // What is imposed comes with the correction: nodes that are put there alone would tear at the others.
  now_.state.u = std::move(u);
  newton_.begin_moved();
}

void StaticRun::pair(double time, const Eigen::VectorXd& u, GeometryUpdates* updates) {
  now_.paired = true;
  if (!problem_.contact) return;
  // Without updates surfaces face each other as the computation begins, in the discrete formulation as each step does
  // (U4.44.11; Code_Aster 17.3).
  if (problem_.contact->geometry_update == GeometryUpdate::none && !pairs_each_step())
    now_.reference = began_at_;
  else
    now_.reference = updates ? updates->relaxed(now_.reference, u) : u;
  const double margin = updates ? updates->margin() : 0.0;
  const std::vector<Vector3d> places = positions_at(now_.reference, mesh_, dofs_);
  if (mixed_) {
    mixed_->pair(places, time, margin);
  } else {
    now_.pairs = pair_surfaces(*problem_.contact, mesh_, places, time, faced_facets(now_.pairs, margin));
    ++counters_.pairings;
  }
}

void StaticRun::resize_multipliers(const ConditionSet& next) {
  if (now_.state.multipliers.size() != next.slot_count) now_.state.multipliers = Eigen::VectorXd::Zero(next.slot_count);
  // A slot that has lost its row holds nothing any more.
  Eigen::VectorXd kept = Eigen::VectorXd::Zero(next.slot_count);
  for (const int slot : next.row_slots) kept[slot] = now_.state.multipliers[slot];
  now_.state.multipliers = std::move(kept);
}

int StaticRun::active_set_limit() const {
  constexpr int generous = 30;
  const int factor = problem_.contact ? std::max(1, problem_.contact->active_set_factor) : generous;
  return factor * std::max(1, now_.conditions.slot_count);
}

bool StaticRun::pairs_each_step() const {
  return problem_.contact && problem_.contact->formulation == ContactFormulation::discrete;
}

bool StaticRun::thickness_changes() const {
  return problem_.contact &&
         std::ranges::any_of(problem_.contact->zones, [](const ContactZone& zone) { return zone.thickness_changes; });
}

}  // namespace comma::solver
