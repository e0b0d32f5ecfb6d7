// Which instants are computed: those of a list, finer where a step fails, shorter or longer as the iterations go.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace comma::solver {

/// A step that fails is cut into equal parts, and a part that fails again, down to a depth (U4.34.03, ECHEC). Where
/// steps adapt, the first part alone is meant: what follows adapts from its length, and the shortest step is the only
/// bound (Code_Aster 17.3).
struct StepCutting {
  int parts = 4;           ///< SUBD_PAS
  int depth = 3;           ///< SUBD_NIVEAU: how often a step and its parts may be cut
  double shortest = 0.0;   ///< s, SUBD_PAS_MINI: no part may be shorter
  bool automatic = false;  ///< SUBD_METHODE='AUTO': into `parts`, of which the first is half as long as the others
                           ///< where the residuals of `telling_iterations` or more tell how they go on,
                           ///< `automatic_depth` times (17.3)
};

/// How often a step may be cut where the program chooses the parts.
inline constexpr int automatic_depth = 20;

/// From so many residuals on a line through them tells when they will be small enough (17.3).
inline constexpr int telling_iterations = 7;

/// A field whose change in a step is watched.
struct WatchedIncrement {
  std::string field;  ///< DEPL, SIEF_ELGA, VARI_ELGA
  std::string component;
  std::vector<int> nodes;  ///< empty: all
  std::vector<int> cells;  ///< empty: all
  double wanted = 0.0;     ///< VALE_REF: the largest change of a step that is aimed at
};

/// What a step must not do besides failing to converge (U4.34.03, EVENEMENT).
enum class StepEventKind : std::uint8_t {
  divergence,  ///< DIVE_RESI: neither of the last two residuals is below the one before them
  residual,    ///< RESI_MAXI: a residual beyond a limit
  increment,   ///< DELTA_GRANDEUR: a field changes by more than a limit
  collision,   ///< COLLISION: points of contact close or open
  depth        ///< INTERPENETRATION: a penalised point goes deeper than a limit
};

/// Around a collision steps are no longer than a length, for a while (SUBD_INST, SUBD_DUREE).
struct CollisionSteps {
  double length = 0.0;    ///< s
  double duration = 0.0;  ///< s
};

struct StepEvent {
  StepEventKind kind = StepEventKind::divergence;
  double limit = 0.0;                         ///< N of a residual, m of a depth
  std::optional<WatchedIncrement> increment;  ///< of `increment`: its `wanted` is the limit
  std::optional<StepCutting> cutting;  ///< absent: the computation ends, unless one of the two below says what is done
  std::optional<CollisionSteps> around;   ///< of `collision`
  std::optional<double> most_stiffening;  ///< of `depth`: the penalty is raised, at most by this factor (COEF_MAXI)
};

/// By what factor the next step is longer, and when (U4.34.03, an occurrence of ADAPTATION).
struct AdaptationRule {
  bool always = false;                ///< TOUT_INST: after each step; else after some with few iterations
  std::optional<int> few_iterations;  ///< VALE_I: with at most so many; absent: `usual_iterations`
  bool strict = false;                ///< CRIT_COMP LT, GE: with fewer
  bool beyond = false;                ///< CRIT_COMP GT, GE: with more instead
  int needed = 2;                     ///< NB_INCR_SEUIL: in so many steps, with others in between or not (17.3)
  double growth = 1.0;                ///< PCENT_AUGM: longer by this share
  double least_factor = 0.0;          ///< of `increment`
  double most_factor = std::numeric_limits<double>::infinity();
  std::optional<int> wanted_iterations;       ///< NB_ITER_NEWTON_REF: instead, by sqrt(wanted / (taken + 1))
  std::optional<WatchedIncrement> increment;  ///< DELTA_GRANDEUR: instead, by wanted / largest change in the last
};

/// Steps between the instants of the list adapt: of the rules whose time has come the one with the smallest factor
/// counts.
struct StepAdaptation {
  double shortest = 0.0;                                     ///< s, PAS_MINI
  double longest = std::numeric_limits<double>::infinity();  ///< s, PAS_MAXI
  long most_steps = 1000000;                                 ///< NB_PAS_MAXI
  int usual_iterations = 5;                                  ///< half of the most that Newton's method may take
  std::vector<AdaptationRule> rules = {AdaptationRule()};
};

struct StepPlan {
  std::vector<double> instants;  ///< s, rising; the first is the initial state
  std::optional<StepCutting> cutting;
  std::optional<StepAdaptation> adaptation;
  std::vector<StepEvent> events;
  double further_iterations = 0.0;  ///< PCENT_ITER_PLUS: share of the most iterations that is allowed beyond them where
                                    ///< the residuals promise to get there
  bool tries_other_solution = false;  ///< ACTION='AUTRE_PILOTAGE': a step of path following that fails is tried with
                                      ///< the other of two solutions before it is cut
  bool stops_when_unstable = false;   ///< EVENEMENT='INSTABILITE', ACTION='ARRET'

  StepPlan() = default;
  /// The instants as they are; a step that fails ends the computation.
  StepPlan(std::vector<double> given) : instants(std::move(given)) {}

  /// The first of a kind; null where there is none.
  const StepEvent* event(StepEventKind kind) const;
};

/// Walks through a plan.
class StepSequence {
 public:
  explicit StepSequence(StepPlan plan);

  bool finished() const { return pending_.empty(); }
  /// Where the next step goes to.
  double target() const;
  /// Whether the next step is a part of one that was cut.
  bool is_part() const { return depth() > 0; }
  /// How often the step towards the next target has been cut; where steps adapt, how many steps that were cut would
  /// have ended later.
  int depth() const;
  /// It has converged, in so many iterations and with such largest changes of the watched fields, one a rule that
  /// watches one. After StepAdaptation::most_steps the sequence is finished, wherever it is.
  void accept(int iterations, std::span<const double> changes = {});
  /// It has converged in so many iterations, and is to be cut all the same: it counts among the easy ones (17.3).
  void reject(int iterations) { count_easy(iterations); }
  /// It has failed: those before it do not count as easy any more.
  void forget_easy_steps() { std::ranges::fill(easy_steps_, 0); }
  /// False when it may not be cut, else the next target is nearer. By the plan's rule, or by another, after so many
  /// iterations.
  bool cut(int iterations = 0);
  /// Whether cut() would.
  bool may_be_cut() const { return plan_.cutting && first_part(*plan_.cutting, 0).has_value(); }
  bool cut(const StepCutting& rule, int iterations = 0);
  /// Steps from here on are no longer than these; false where this one is not.
  bool refine(const CollisionSteps& around);

 private:
  struct Stop {
    double instant;
    int depth;  ///< how often the step towards it has been cut
  };

  double planned_target() const;
  double adapted_target() const;
  std::optional<double> first_part(const StepCutting& rule, int iterations) const;
  void push_parts(const StepCutting& rule, double end, int depth, int iterations);
  void adapt(int iterations, std::span<const double> changes);
  void count_easy(int iterations);

  StepPlan plan_;
  double now_;
  std::vector<Stop> pending_;     ///< the nearest last
  double length_;                 ///< s, of the next adapted step
  double base_ = 0.0;             ///< s, of the last step that no instant of the list made shorter
  std::vector<double> cut_ends_;  ///< s, of adapted steps that were cut
  CollisionSteps around_;
  double fine_until_;            ///< s: no step before it is longer than that of `around_`
  std::vector<int> easy_steps_;  ///< since the rule last held or a step failed, by rule
  long steps_ = 0;
};

}  // namespace comma::solver
