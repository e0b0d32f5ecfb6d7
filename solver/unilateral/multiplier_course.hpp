// Multipliers from step to step.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>

namespace comma::solver {

/// Where loads grow steadily, so do the forces of contact but for what the geometry changes: begun with those that the
/// steps before lead to, a step has many digits less to find.
class MultiplierCourse {
 public:
  /// What a polynomial through the last steps comes to at a time, for a step that goes on from the last one with its
  /// multipliers; else these. The polynomial goes through as many steps as would have foretold the last one best, or
  /// one more where that was as many as there were. A multiplier that is zero stays so, and none becomes negative.
  Eigen::VectorXd expected(double time, const Eigen::VectorXd& multipliers) const;
  /// What the first step begins with, and when: nothing afterwards. It counts for the next two: where contact comes
  /// about, it does so from another geometry than that of later steps, which foretell each other better from then on.
  void begin(double time, const Eigen::VectorXd& multipliers);
  /// The solution of a step. Those of the same time and later ones are no more.
  void note(double time, const Eigen::VectorXd& multipliers);

 private:
  /// With steps of equal length rounding grows by 31 in a polynomial through five.
  static constexpr std::size_t most = 5;

  struct Step {
    double time;
    Eigen::VectorXd multipliers;
  };
  static Eigen::VectorXd extrapolated(std::span<const Step> steps, double time);
  std::size_t best_count() const;

  std::vector<Step> steps_;  ///< the last one at the end
  bool begins_ = false;      ///< the first of them is no step, but what the first one began with
};

}  // namespace comma::solver
