#include "solver/nonlinear/steps/step_watch.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/nonlinear/steps/watched_increment.hpp"

namespace comma::solver {

StepWatch::StepWatch(const StepPlan& plan, const Mesh& mesh) : plan_(plan), mesh_(mesh) {
  if (const StepEvent* event = plan.event(StepEventKind::increment)) limited_ = {*event->increment, {}};
  if (!plan.adaptation) return;
  for (const AdaptationRule& rule : plan.adaptation->rules)
    if (rule.increment) adapting_.push_back({*rule.increment, {}});
}

void StepWatch::take(const ResultStep& step) {
  if (limited_) limited_->values = watched_values(limited_->increment, step, mesh_);
  for (WatchedField& each : adapting_) {
    auto now = watched_values(each.increment, step, mesh_);
    each.change = largest_change(each.values, now);
    each.values = std::move(now);
  }
}

const StepEvent* StepWatch::event_behind(std::string_view code) const {
  if (code == "residual-diverges") return plan_.event(StepEventKind::divergence);
  if (code == "residual-too-large") return plan_.event(StepEventKind::residual);
  if (code == "increment-too-large") return plan_.event(StepEventKind::increment);
  return code == "contact-too-deep" ? plan_.event(StepEventKind::depth) : nullptr;
}

void StepWatch::compare(double instant, const ResultStep& now) {
  const WatchedIncrement& watched = limited_->increment;
  const double change = largest_change(limited_->values, watched_values(watched, now, mesh_));
  constexpr double rounding = 1e-9;
  if (change <= watched.wanted * (1.0 + rounding)) return;
  throw Error("increment-too-large",
              fmt::format("t = {:.6g}: {} of {} changes by {:.4g} in one step, more than the {:.4g} allowed", instant,
                          watched.component, watched.field, change, watched.wanted),
              "take smaller steps, or allow more (VALE_REF)");
}

std::vector<double> StepWatch::changes() const {
  std::vector<double> changes;
  for (const WatchedField& each : adapting_) changes.push_back(each.change);
  return changes;
}

void check_depth(const StepEvent* event, double instant, double depth) {
  if (event == nullptr || depth <= event->limit) return;
  throw Error("contact-too-deep",
              fmt::format("t = {:.6g}: a point of contact is {:.4g} deep, more than the {:.4g} allowed", instant, depth,
                          event->limit),
              "take a larger penalty, or let it be raised (ACTION='ADAPT_COEF_PENA')");
}

}  // namespace comma::solver
