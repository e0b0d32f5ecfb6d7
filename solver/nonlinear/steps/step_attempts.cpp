// The part of StaticRun that takes a step, and tries another way where one fails.
#include <fmt/format.h>

#include "solver/contact/watched_zones.hpp"
#include "solver/error.hpp"
#include "solver/nonlinear/contact/geometry_updates.hpp"
#include "solver/nonlinear/failure.hpp"
#include "solver/nonlinear/steps/static_run.hpp"
#include "solver/on_exit.hpp"

namespace comma::solver {

std::optional<int> StaticRun::try_step(double instant, StepSequence& sequence) {
  const Progress before = now_;
  const std::vector<char> closed_before = closed_points();
  const long iterations_before = counters_.newton_iterations;
  may_cut_ = sequence.may_be_cut();
  if (mixed_) mixed_->remember();
  const auto watched = [&](int iterations) {
    watch_->check_increment(instant, [&] { return fields_now(instant); });
    if (mixed_) check_depth(plan_->event(StepEventKind::depth), instant, mixed_->penetration(now_.state.u, true));
    return iterations;
  };
  try {
    const int iterations = watched(solve_jointly_or_settled(instant, before, sequence.is_part()));
    if (!refines_collision(closed_before, sequence)) return iterations;
    return take_again(instant, before, sequence);
  } catch (const Error& error) {
    const StepEvent* event = watch_->event_behind(error.code());
    if (event == nullptr && !is_failure_of_step(error.code())) throw advised(error, problem_, tangent_.unheld());
    const int tried = static_cast<int>(counters_.newton_iterations - iterations_before);
    event && event->increment ? sequence.reject(tried) : sequence.forget_easy_steps();
    if (event ? !event->cutting || !sequence.cut(*event->cutting, tried) : !sequence.cut(tried)) {
      if (event && !event->cutting) throw;
      if (event) throw cut_no_further(error, sequence.depth());
      // In a part of a step contact has been settled already.
      if (sequence.is_part()) throw cut_no_further(advised(error, problem_, tangent_.unheld()), sequence.depth());
      return watched(solve_as_last_resort(instant, before, error));
    }
    take_back(before);
    tell_failure(instant, error, fmt::format("cut, on to {:.6g}", sequence.target()));
    return std::nullopt;
  }
}

std::nullopt_t StaticRun::take_again(double instant, const Progress& before, const StepSequence& sequence) {
  take_back(before);
  if (observer_)
    observer_(event_of_step(instant, fmt::format("step to {:.6g} meets a change of contact: cut, on to {:.6g}", instant,
                                                 sequence.target())));
  return std::nullopt;
}

void StaticRun::tell_failure(double instant, const Error& error, std::string_view then) const {
  if (!observer_) return;
  const std::string message = error.what();
  observer_(event_of_step(instant,
                          fmt::format("step to {:.6g} fails ({}): {}", instant, short_cause(error.code()), then),
                          message.substr(0, message.find('\n'))));
}

std::vector<char> StaticRun::closed_points() const {
  if (mixed_) return mixed_->closed_points();
  std::vector<char> closed;
  for (const double multiplier : now_.state.multipliers) closed.push_back(multiplier > 0.0);
  return closed;
}

bool StaticRun::refines_collision(const std::vector<char>& before, StepSequence& sequence) const {
  const StepEvent* event = plan_->event(StepEventKind::collision);
  if (event == nullptr) return false;
  const std::vector<char> now = closed_points();
  if (before.size() != now.size() || before == now) return false;
  if (event->around) return sequence.refine(*event->around);
  if (event->cutting) return sequence.cut(*event->cutting);
  throw Error(
      "contact-changes",
      fmt::format("points of contact close or open in the step to t = {:.6g}, and the computation is to stop there",
                  sequence.target()),
      "write ACTION='DECOUPE' to go on in shorter steps");
}

int StaticRun::solve_jointly_or_settled(double instant, const Progress& before, bool is_part) {
  try {
    return solve_from_either_side(instant, before);
  } catch (const Error& error) {
    const bool is_cut_first = assembler_.has_memory() && !is_part;
    if (!mixed_ || !mixed_->is_linear() || is_cut_first || !is_failure_of_step(error.code())) throw;
  }
  return solve_settled(instant, before);
}

int StaticRun::solve_settled(double instant, const Progress& before) {
  take_back(before);
  if (observer_)
    observer_(event_of_step(instant,
                            fmt::format("step to {:.6g}: again, with contact settled within each iteration", instant)));
  mixed_->iterate(MixedContact::Iterations::settled);
  const OnExit as_before([&] { mixed_->iterate(contact_iterations()); });
  return solve_from_either_side(instant, before);
}

int StaticRun::solve_as_last_resort(double instant, const Progress& before, const Error& error) {
  if (!mixed_ || !mixed_->is_linear() || !assembler_.has_memory()) throw advised(error, problem_, tangent_.unheld());
  try {
    return solve_settled(instant, before);
  } catch (const Error& again) {
    throw advised(again, problem_, tangent_.unheld());
  }
}

int StaticRun::solve_from_either_side(double instant, const Progress& before) {
  try {
    return solve_and_check(instant);
  } catch (const Error& error) {
    if (mixed_ && error.code() == "contact-cycling" && tangent_.spring_weak_supports())
      return solve_on_stiffer_supports(instant, before, error);
    if (const auto iterations = solve_the_other_way(instant, before, error)) return *iterations;
    if (takes_plain_tangents_ && !may_cut_ && is_failure_of_step(error.code()))
      return solve_by_derivative(instant, before, error);
    const bool may_unload = assembler_.has_memory() && options_.tangent.prediction == TangentKind::tangent;
    if (!may_unload || may_cut_ || path_ || !is_failure_of_step(error.code())) throw;
    take_back(before);
    tell_failure(instant, error, "again from an elastic prediction");
  }
  newton_.predict_with(TangentKind::unloading);
  const OnExit as_before([&] { newton_.predict_with(options_.tangent.prediction); });
  return solve_and_check(instant);
}

int StaticRun::solve_by_derivative(double instant, const Progress& before, const Error& failure) {
  take_back(before);
  tell_failure(instant, failure, "again with the derivative of the forces of turning beams");
  tangent_.take_derivative();
  const OnExit as_before([&] {
    tangent_.forget();
    tangent_.stay_symmetric();
  });
  return solve_and_check(instant);
}

int StaticRun::solve_on_stiffer_supports(double instant, const Progress& before, const Error& failure) {
  take_back(before);
  try {
    return solve_from_either_side(instant, before);
  } catch (const Error& error) {
    if (error.code() == "singular-matrix") throw failure;
    throw;
  }
}

std::optional<int> StaticRun::solve_the_other_way(double instant, const Progress& before, const Error& failure) {
  if (!path_ || !plan_->tries_other_solution || !is_failure_of_step(failure.code())) return std::nullopt;
  take_back(before);
  tell_failure(instant, failure, "again with the other intensity");
  path_->take_other_solution(true);
  const OnExit as_before([&] { path_->take_other_solution(false); });
  try {
    return solve_and_check(instant);
  } catch (const Error& error) {
    if (!is_failure_of_step(error.code())) throw;
    return std::nullopt;
  }
}

int StaticRun::solve_and_check(double instant) {
  const int iterations = solve_telling_when(instant);
  if (problem_.contact && problem_.contact->stop_on_interpenetration)
    require_no_interpenetration(*problem_.contact, mesh_, positions(), instant);
  return iterations;
}

/// What settles contact knows no instants, and laws at points know none either.
int StaticRun::solve_telling_when(double instant) {
  try {
    return solve_step(instant);
  } catch (const Error& error) {
    const std::string message = error.what();
    const bool knows_none = error.code() != "no-convergence" && is_failure_of_step(error.code());
    if (!knows_none || message.find(" t = ") != std::string::npos) throw;
    throw Error(error.code(), fmt::format("{}, in the step to t = {:.6g}", message, instant), error.hint());
  }
}

void StaticRun::take_back(const Progress& before) {
  now_ = before;
  if (!mixed_) return;
  mixed_->restore();
  now_.paired = false;
}

}  // namespace comma::solver
