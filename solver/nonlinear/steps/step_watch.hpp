// What a plan of steps looks at in each step beside its convergence (U4.34.03, ECHEC and ADAPTATION).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "solver/fields/data/field.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/nonlinear/steps/step_sequence.hpp"

namespace comma::solver {

/// Follows the fields whose changes matter, and knows what is done where a step goes too far.
class StepWatch {
 public:
  /// Keeps references.
  StepWatch(const StepPlan& plan, const Mesh& mesh);

  /// The event of the plan that an error stands for; null: none.
  const StepEvent* event_behind(std::string_view code) const;

  /// `step` is what the next one is compared with: it has been accepted, or the computation begins from it. Throws what
  /// watched_values throws.
  void take(const ResultStep& step);

  /// Throws Error `increment-too-large` where the watched field changes by more than is allowed from the step that was
  /// taken last to the next one, which has the fields of `now`.
  template <class FieldsNow>
  void check_increment(double instant, FieldsNow&& now) {
    if (limited_) compare(instant, now());
  }

  /// Of the fields that adapt steps, one a rule, in the step that was taken last.
  std::vector<double> changes() const;

 private:
  struct WatchedField {
    WatchedIncrement increment;
    std::vector<double> values;  ///< of the step that was taken last
    double change = 0.0;         ///< in that step
  };

  void compare(double instant, const ResultStep& now);

  const StepPlan& plan_;
  const Mesh& mesh_;
  std::optional<WatchedField> limited_;
  std::vector<WatchedField> adapting_;
};

/// Throws Error `contact-too-deep` where the event is given and `depth` (m) is beyond its limit.
void check_depth(const StepEvent* event, double instant, double depth);

}  // namespace comma::solver
