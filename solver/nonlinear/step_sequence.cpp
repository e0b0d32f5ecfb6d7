#include "solver/nonlinear/step_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

/// A step that ends this close before an instant of the list goes to that instant.
constexpr double same_instant = 1e-9;

}  // namespace

StepSequence::StepSequence(StepPlan plan) : plan_(std::move(plan)), now_(plan_.instants.front()), length_(0.0) {
  for (std::size_t k = plan_.instants.size(); k-- > 1;) pending_.push_back({plan_.instants[k], 0});
  if (!pending_.empty()) length_ = pending_.back().instant - now_;
  if (plan_.adaptation) length_ = std::min(length_, plan_.adaptation->longest);
}

double StepSequence::adapted_target() const {
  const double wall = pending_.back().instant;
  const double wanted = now_ + length_;
  return wanted >= wall - same_instant * (wall - now_) ? wall : wanted;
}

double StepSequence::target() const {
  return plan_.adaptation && pending_.back().depth == 0 ? adapted_target() : pending_.back().instant;
}

void StepSequence::accept(int iterations, double increment) {
  const double reached = target();
  const double length = reached - now_;
  now_ = reached;
  const bool whole = pending_.back().depth == 0;
  if (reached >= pending_.back().instant) pending_.pop_back();
  if (!plan_.adaptation) return;
  if (++steps_ >= plan_.adaptation->most_steps && !finished())
    throw Error("too-many-steps", fmt::format("t = {:.6g} is reached after {} steps, the most that are allowed", now_, steps_),
                "raise NB_PAS_MAXI or PAS_MINI");
  // A step cut short by an instant of the list says nothing about the length to take.
  adapt(whole && !plan_.adaptation->increment ? std::max(length_, length) : length, iterations, increment);
}

void StepSequence::adapt(double length, int iterations, double increment) {
  const StepAdaptation& rule = *plan_.adaptation;
  length_ = length;
  if (rule.increment) {
    if (increment > 0.0) length_ *= rule.increment->wanted / increment;
  } else if (rule.wanted_iterations) {
    length_ *= std::sqrt(static_cast<double>(*rule.wanted_iterations) / (iterations + 1));
  } else {
    easy_steps_ = iterations <= rule.few_iterations ? easy_steps_ + 1 : 0;
    if (easy_steps_ < rule.in_a_row) return;
    easy_steps_ = 0;
    length_ *= 1.0 + rule.growth;
  }
  length_ = std::clamp(length_, rule.shortest, std::max(rule.shortest, rule.longest));
}

bool StepSequence::cut() {
  if (!plan_.cutting) return false;
  const double end = target();
  const int depth = pending_.back().depth;
  const StepCutting& rule = *plan_.cutting;
  const double part = (end - now_) / rule.parts;
  const double shortest = std::max(rule.shortest, plan_.adaptation ? plan_.adaptation->shortest : 0.0);
  if (depth >= rule.depth || part < shortest || now_ + part <= now_) return false;
  if (end >= pending_.back().instant) pending_.pop_back();
  for (int k = rule.parts; k > 0; --k) pending_.push_back({k == rule.parts ? end : now_ + k * part, depth + 1});
  easy_steps_ = 0;
  return true;
}

}  // namespace comma::solver
