// Which instants are computed: those of a list, finer where a step fails, shorter or longer as the iterations go.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace comma::solver {

/// A step that fails is cut into equal parts, and a part that fails again, down to a depth (U4.34.03, ECHEC).
struct StepCutting {
  int parts = 4;          ///< SUBD_PAS
  int depth = 3;          ///< SUBD_NIVEAU: how often a step and its parts may be cut
  double shortest = 0.0;  ///< s, SUBD_PAS_MINI: no part may be shorter
};

/// A field whose change in a step is watched.
struct WatchedIncrement {
  std::string field;      ///< DEPL, SIEF_ELGA, VARI_ELGA
  std::string component;
  std::vector<int> nodes;  ///< empty: all
  std::vector<int> cells;  ///< empty: all
  double wanted = 0.0;     ///< VALE_REF: the largest change of a step that is aimed at
};

/// Steps between the instants of the list adapt to the number of Newton iterations (U4.34.03, ADAPTATION).
struct StepAdaptation {
  double shortest = 0.0;                                   ///< s, PAS_MINI
  double longest = std::numeric_limits<double>::infinity();  ///< s, PAS_MAXI
  long most_steps = 1000000;                               ///< NB_PAS_MAXI
  int few_iterations = 5;  ///< VALE_I: with at most so many ...
  int in_a_row = 2;        ///< NB_INCR_SEUIL: ... in so many steps one after the other ...
  double growth = 1.0;     ///< PCENT_AUGM: ... the next is longer by this share
  std::optional<int> wanted_iterations;  ///< NB_ITER_NEWTON_REF: instead, each step is longer by sqrt(wanted / (taken + 1))
  std::optional<WatchedIncrement> increment;  ///< DELTA_GRANDEUR: instead, each step is longer by wanted / largest change in the last
};

struct StepPlan {
  std::vector<double> instants;  ///< s, rising; the first is the initial state
  std::optional<StepCutting> cutting;
  std::optional<StepAdaptation> adaptation;

  StepPlan() = default;
  /// The instants as they are; a step that fails ends the computation.
  StepPlan(std::vector<double> given) : instants(std::move(given)) {}
};

/// Walks through a plan.
class StepSequence {
 public:
  explicit StepSequence(StepPlan plan);

  bool finished() const { return pending_.empty(); }
  /// Where the next step goes to.
  double target() const;
  /// It has converged, in so many iterations and with such a largest change of the watched field. Throws Error `too-many-steps` beyond StepAdaptation::most_steps.
  void accept(int iterations, double increment = 0.0);
  /// It has failed: false when it may not be cut, else the next target is nearer.
  bool cut();

 private:
  struct Stop {
    double instant;
    int depth;  ///< how often the step towards it has been cut
  };

  double adapted_target() const;
  void adapt(double length, int iterations, double increment);

  StepPlan plan_;
  double now_;
  std::vector<Stop> pending_;  ///< the nearest last
  double length_;              ///< s, of the next adapted step
  int easy_steps_ = 0;
  long steps_ = 0;
};

}  // namespace comma::solver
