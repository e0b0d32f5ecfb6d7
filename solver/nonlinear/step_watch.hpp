// What a plan of steps looks at in each step beside its convergence (U4.34.03, ECHEC and ADAPTATION).
#pragma once

#include <string_view>
#include <vector>

#include "solver/fields/field.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/nonlinear/step_sequence.hpp"

namespace comma::solver {

/// Follows the fields whose changes matter, and knows what is done where a step goes too far.
class StepWatch {
 public:
  /// Keeps references. `last`: the step that the computation begins from. Throws what watched_values throws.
  StepWatch(const StepPlan& plan, const Mesh& mesh, const ResultStep& last);

  /// The event of the plan that an error stands for; null: none.
  const StepEvent* event_behind(std::string_view code) const;

  /// Nothing is known of the next step yet.
  void start_step() { share_ = half_a_step; }

  /// Throws Error `increment-too-large` where the watched field changes by more than is allowed from one step to the next, which has the fields of `now`.
  template <class FieldsNow>
  void check_increment(double instant, const ResultStep& last, FieldsNow&& now) {
    if (const StepEvent* event = plan_.event(StepEventKind::increment)) compare(*event->increment, instant, last, now());
  }

  /// How much of the last step that was checked might have been gone.
  double share_of_step() const { return share_; }

  /// Of the fields that adapt steps, one a rule, in the step that has just been accepted.
  std::vector<double> changes(const ResultStep& accepted);

 private:
  struct WatchedField {
    WatchedIncrement increment;
    std::vector<double> before;
  };

  /// Where nothing tells how far a step might have gone.
  static constexpr double half_a_step = 0.5;

  void compare(const WatchedIncrement& watched, double instant, const ResultStep& last, const ResultStep& now);

  const StepPlan& plan_;
  const Mesh& mesh_;
  double share_ = half_a_step;
  std::vector<WatchedField> adapting_;
};

/// Throws Error `contact-too-deep` where the event is given and `depth` (m) is beyond its limit.
void check_depth(const StepEvent* event, double instant, double depth);

}  // namespace comma::solver
