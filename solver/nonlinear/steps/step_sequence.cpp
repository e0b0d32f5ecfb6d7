#include "solver/nonlinear/steps/step_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

/// A step that ends this close before an instant of the list goes to that instant.
constexpr double coincident_instants = 1e-9;

bool is_easy(const AdaptationRule& rule, int usual_iterations, int iterations) {
  // The prediction does not count. GE counts from one less on, as LT counts up to one less.
  const int few = rule.few_iterations.value_or(usual_iterations) - (rule.strict ? 1 : 0);
  return (iterations - 1 <= few) != rule.beyond;
}

double factor_of(const AdaptationRule& rule, int iterations, double change) {
  if (rule.increment)
    return change > 0.0 ? std::clamp(rule.increment->wanted / change, rule.least_factor, rule.most_factor)
           : std::isfinite(rule.most_factor) ? rule.most_factor
                                             : 1.0;
  if (rule.wanted_iterations) return std::sqrt(static_cast<double>(*rule.wanted_iterations) / (iterations + 1));
  return 1.0 + rule.growth;
}

/// How much of a part the first one lacks.
double part_left_out(const StepCutting& rule, int iterations) {
  return rule.automatic && iterations >= telling_iterations ? 0.5 : 0.0;
}

}  // namespace

const StepEvent* StepPlan::event(StepEventKind kind) const {
  const auto found = std::ranges::find(events, kind, &StepEvent::kind);
  return found == events.end() ? nullptr : &*found;
}

StepSequence::StepSequence(StepPlan plan)
    : plan_(std::move(plan)), now_(plan_.instants.front()), length_(0.0), fine_until_(now_) {
  for (std::size_t k = plan_.instants.size(); k-- > 1;) pending_.push_back({plan_.instants[k], 0});
  if (!pending_.empty()) length_ = pending_.back().instant - now_;
  if (!plan_.adaptation) return;
  easy_steps_.assign(plan_.adaptation->rules.size(), 0);
}

double StepSequence::adapted_target() const {
  const double wall = pending_.back().instant;
  const double wanted = now_ + length_;
  // No step that is shorter than the shortest is left before an instant of the list (17.3).
  const double margin = std::max(coincident_instants * (wall - now_), plan_.adaptation->shortest);
  return wanted >= wall - margin ? wall : wanted;
}

double StepSequence::planned_target() const { return plan_.adaptation ? adapted_target() : pending_.back().instant; }

double StepSequence::target() const {
  const double planned = planned_target();
  const double fine = now_ + around_.length;
  return now_ < fine_until_ && fine < planned - coincident_instants * around_.length ? fine : planned;
}

bool StepSequence::refine(const CollisionSteps& around) {
  const double before = target();
  if (before - now_ <= around.length * (1.0 + coincident_instants)) return false;
  around_ = around;
  fine_until_ = now_ + around.duration;
  return target() < before;
}

void StepSequence::accept(int iterations, std::span<const double> changes) {
  const double reached = target();
  const double length = reached - now_;
  now_ = reached;
  if (reached >= pending_.back().instant) pending_.pop_back();
  if (!plan_.adaptation) return;
  if (++steps_ >= plan_.adaptation->most_steps) {
    pending_.clear();
    return;
  }
  // What follows a step that an instant of the list made shorter adapts from the length of the one before it; the
  // change of a field counts as it was (Code_Aster 17.3).
  if (base_ == 0.0 || length >= length_ * (1.0 - coincident_instants)) base_ = length;
  adapt(iterations, changes);
}

void StepSequence::count_easy(int iterations) {
  for (std::size_t k = 0; k < easy_steps_.size(); ++k)
    if (is_easy(plan_.adaptation->rules[k], plan_.adaptation->usual_iterations, iterations)) ++easy_steps_[k];
}

void StepSequence::adapt(int iterations, std::span<const double> changes) {
  const StepAdaptation& adaptation = *plan_.adaptation;
  count_easy(iterations);
  std::optional<double> factor;
  std::size_t read = 0;
  for (std::size_t k = 0; k < adaptation.rules.size(); ++k) {
    const AdaptationRule& rule = adaptation.rules[k];
    const double change = rule.increment && read < changes.size() ? changes[read++] : 0.0;
    if (!rule.always && easy_steps_[k] < rule.needed) continue;
    easy_steps_[k] = 0;
    factor = std::min(factor.value_or(std::numeric_limits<double>::infinity()), factor_of(rule, iterations, change));
  }
  length_ = base_;
  if (factor && !finished() && length_ * *factor < adaptation.shortest)
    throw Error(
        "step-too-short",
        fmt::format(
            "after t = {:.6g} the steps are to adapt to {:.6g}, shorter than the shortest allowed (PAS_MINI = {:.6g})",
            now_, length_ * *factor, adaptation.shortest),
        "lower PAS_MINI, or let steps shrink less (PCENT_AUGM, INCR_GRAN or NB_ITER_NEWTON_REF of ADAPTATION)");
  length_ = std::min(length_ * factor.value_or(1.0), std::max(adaptation.shortest, adaptation.longest));
  if (!finished() && now_ + length_ <= now_)
    throw Error("too-many-steps",
                fmt::format("steps become shorter and shorter, and at t = {:.6g} the next one has no length", now_),
                "give PAS_MINI, or let steps grow (PCENT_AUGM)");
}

bool StepSequence::cut(int iterations) { return plan_.cutting && cut(*plan_.cutting, iterations); }

/// Its length; nothing where the step may not be cut.
std::optional<double> StepSequence::first_part(const StepCutting& rule, int iterations) const {
  const double left_out = part_left_out(rule, iterations);
  const double first = (target() - now_) * ((1.0 - left_out) / (rule.parts - left_out));
  const double shortest = std::max(rule.shortest, plan_.adaptation ? plan_.adaptation->shortest : 0.0);
  if (first < shortest || now_ + first <= now_) return std::nullopt;
  if (!plan_.adaptation && depth() >= (rule.automatic ? automatic_depth : rule.depth)) return std::nullopt;
  return first;
}

bool StepSequence::cut(const StepCutting& rule, int iterations) {
  const std::optional<double> first = first_part(rule, iterations);
  if (!first) return false;
  const double end = target();
  if (plan_.adaptation) {
    cut_ends_.push_back(end);
    length_ = *first;
    return true;
  }
  const int depth = pending_.back().depth;
  if (end >= pending_.back().instant) pending_.pop_back();
  push_parts(rule, end, depth + 1, iterations);
  return true;
}

int StepSequence::depth() const {
  if (!plan_.adaptation) return pending_.back().depth;
  return static_cast<int>(std::ranges::count_if(cut_ends_, [&](double end) { return end > now_; }));
}

void StepSequence::push_parts(const StepCutting& rule, double end, int depth, int iterations) {
  const double left_out = part_left_out(rule, iterations);
  const double length = (end - now_) / (rule.parts - left_out);
  pending_.push_back({end, depth});
  for (int k = rule.parts - 1; k > 0; --k) pending_.push_back({now_ + (k - left_out) * length, depth});
}

}  // namespace comma::solver
