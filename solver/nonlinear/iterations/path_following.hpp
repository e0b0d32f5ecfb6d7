// Newton's iterations of one step whose load intensity is an unknown (R5.03.80).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/elements/assembler.hpp"
#include "solver/fields/relation_multipliers.hpp"
#include "solver/nonlinear/iterations/convergence.hpp"
#include "solver/nonlinear/iterations/elastic_prediction.hpp"
#include "solver/nonlinear/iterations/held_reactions.hpp"
#include "solver/nonlinear/iterations/reference_forces.hpp"
#include "solver/nonlinear/iterations/strain_control.hpp"
#include "solver/nonlinear/iterations/tangent_system.hpp"
#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// What stays the same and what the intensity multiplies, at the end of a step.
struct DrivenLoads {
  Eigen::VectorXd fixed;  ///< forces over all degrees of freedom
  Eigen::VectorXd driven;
  Eigen::VectorXd fixed_offset;  ///< g of u = T q + g
  Eigen::VectorXd driven_offset;
};

/// An iteration solves K d = R + intensity F for the correction d, which is d0 + intensity d1 with two right-hand sides
/// and one factor; the measure of the whole increment then gives the intensity (Batoz and Dhatt, International Journal
/// for Numerical Methods in Engineering 14, 1979; Crisfield, Computers and Structures 13, 1981). Where it leaves two,
/// and iterations that choose between them in the user's way go to and fro without converging, a step that may not be
/// cut begins again: the first iteration chooses, and the others stay with the one that is nearest. Where the choice is
/// by the angle, multipliers of relations count in the length of an increment as displacements do, from zero where the
/// computation begins: so Code_Aster 17.3 chooses. Without contact and unilateral
/// conditions.
class PathFollowing {
 public:
  /// Keeps references to its arguments. Throws Error `unknown-dof` where a controlled node lacks a component.
  PathFollowing(const StaticProblem& problem, const DofMap& dofs, const Assembler& assembler,
                const Elimination& elimination, const NewtonOptions& options, Counters& counters,
                TangentSystem& tangent, const ReferenceForces& reference, const IterationObserver& observer);

  /// Takes q and u from the beginning of a step to its end, `duration` later in time. `is_last_resort`: whether a step
  /// that fails may begin again. Returns the number of iterations.
  /// Throws Error `no-convergence`, also where no intensity gives the measure asked for, and what the tangent throws.
  int solve(double time, double duration, const DrivenLoads& loads, bool is_last_resort, Eigen::VectorXd& q,
            Eigen::VectorXd& u);

  /// See HeldReactions.
  void set_eliminated(std::vector<int> dofs) { held_.set_eliminated(std::move(dofs)); }
  /// The step is accepted at u.
  void accept_step(const Eigen::VectorXd& u);
  double intensity() const { return intensity_; }
  void set_intensity(double value) { intensity_ = accepted_ = value; }
  /// The path came here by such an increment of displacement, and goes on in its direction where the choice is by the
  /// angle.
  void set_direction(const Eigen::VectorXd& increment) { last_step_ = motions(increment); }
  /// Of two solutions the next steps take the one that the choice passes over, or again the one that it makes.
  void take_other_solution(bool other) { takes_other_ = other; }
  /// Whether the last step has reached a bound of the intensity.
  bool has_ended() const { return ended_; }

 private:
  /// Whole multipliers of relations: constant + intensity * linear.
  struct Multipliers {
    Eigen::VectorXd constant;
    Eigen::VectorXd linear;
  };
  /// Correction of u: constant + intensity * linear.
  struct Correction {
    Eigen::VectorXd constant;
    Eigen::VectorXd linear;
    Multipliers multipliers;   ///< after it, where the choice is by the angle; else empty
    Eigen::VectorXd internal;  ///< forces from which it was found
  };

  /// Which of the intensities an iteration takes.
  enum class Taking : std::uint8_t { first, best, nearest };

  void number_controlled();
  int iterate(bool stays, double wanted, const DrivenLoads& loads, Eigen::VectorXd& q, Eigen::VectorXd& u);
  Correction correction(int iteration, const DrivenLoads& loads, const Eigen::VectorXd& q, const Eigen::VectorXd& u);
  void shorten(double wanted, const DrivenLoads& loads, const Eigen::VectorXd& u, Correction& change);
  std::vector<double> candidates(double wanted, const Correction& change, const Eigen::VectorXd& u) const;
  std::vector<double> by_displacement(double wanted, const Eigen::VectorXd& constant,
                                      const Eigen::VectorXd& linear) const;
  std::vector<double> by_arc_length(double wanted, const Eigen::VectorXd& constant,
                                    const Eigen::VectorXd& linear) const;
  Eigen::VectorXd controlled(const Eigen::VectorXd& u) const;
  Eigen::VectorXd motions(Eigen::VectorXd u) const;
  std::vector<double> admitted(const std::vector<double>& found) const;
  double cost(PathChoice by, double intensity, const Correction& change, const DrivenLoads& loads,
              const Eigen::VectorXd& u);
  Eigen::VectorXd increment(double intensity, const Correction& change, const Eigen::VectorXd& u) const;
  bool knows_direction() const;
  double advance(double intensity, const Correction& change, const Eigen::VectorXd& u) const;
  bool turns_back_by_rounding(const std::vector<double>& choice, const Correction& change, const Eigen::VectorXd& u,
                              double best) const;
  double clearly_best_of(const std::vector<double>& choice, const Correction& change, const DrivenLoads& loads,
                         const Eigen::VectorXd& u);
  double best_of(PathChoice by, const std::vector<double>& choice, const Correction& change, const DrivenLoads& loads,
                 const Eigen::VectorXd& u);
  double chosen(const std::vector<double>& found, const Correction& change, const DrivenLoads& loads,
                const Eigen::VectorXd& u);
  double bounded(double intensity) const;
  double residual_or_infinity(double intensity, const Correction& change, const DrivenLoads& loads,
                              const Eigen::VectorXd& u);
  void evaluate(double intensity, const DrivenLoads& loads, const Eigen::VectorXd& u);
  void take_reactions(double intensity, const Correction& change, const DrivenLoads& loads);
  void tell(const std::string& text) const;
  IterationReport report(int iteration, const ConvergenceCriterion::Measure& measure) const;

  const StaticProblem& problem_;
  const Mesh& mesh_;
  const DofMap& dofs_;
  const Assembler& assembler_;
  const Elimination& elimination_;
  const NewtonOptions& options_;
  const PathControl& control_;
  Counters& counters_;
  TangentSystem& tangent_;
  const IterationObserver& observer_;
  ConvergenceCriterion criterion_;
  const ReferenceForces& reference_;
  HeldReactions held_;
  RelationMultipliers relation_multipliers_;
  std::unique_ptr<ElasticPrediction> prediction_;
  std::unique_ptr<StrainControl> strains_;
  std::vector<int> controlled_;  ///< degrees of freedom
  int controlled_nodes_ = 0;
  double time_ = 0.0;
  double intensity_ = 0.0;
  double accepted_ = 0.0;            ///< intensity of the last accepted step
  Eigen::VectorXd start_;            ///< u where the step begins
  Eigen::VectorXd variable_forces_;  ///< with which the strains of the command variables push in this step
  Eigen::VectorXd last_step_;        ///< increment of the last accepted step; empty before it
  Eigen::VectorXd multipliers_;      ///< of relations, as the last correction leaves them
  Eigen::VectorXd multipliers_start_;
  Eigen::VectorXd balance_;   ///< external less internal forces, on all degrees of freedom
  Eigen::VectorXd residual_;  ///< reduced
  RowWeights weights_;
  double load_ = 0.0;
  int steps_ = 0;
  bool ended_ = false;
  bool takes_other_ = false;
  Taking taking_ = Taking::first;
  bool passed_over_nearest_ = false;  ///< in an iteration after the first of this step
};

}  // namespace comma::solver
