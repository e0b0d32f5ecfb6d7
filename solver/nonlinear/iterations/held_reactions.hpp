// What holds the bodies while iterations go on: the reactions of the linear solves.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/nonlinear/iterations/convergence.hpp"
#include "solver/nonlinear/iterations/reference_forces.hpp"
#include "solver/nonlinear/iterations/tangent_system.hpp"

namespace comma::solver {

/// Multipliers have them so in Code_Aster 17.3, one iteration after the other: what internal forces differ by from
/// them at the unknowns that conditions hold is a residual as well. All vectors are over all degrees of freedom.
class HeldReactions {
 public:
  /// Keeps references to its arguments.
  HeldReactions(const Elimination& elimination, const TangentSystem& tangent)
      : elimination_(elimination), tangent_(tangent) {}

  /// These unknowns are eliminated and have none (AFFE_CHAR_CINE).
  void set_eliminated(std::vector<int> dofs) { eliminated_ = std::move(dofs); }

  /// Those of a correction: `balance`: external less internal forces before it, `change`: the whole of it.
  Eigen::VectorXd of(const Eigen::VectorXd& balance, const Eigen::VectorXd& change) const;
  /// From those of the last correction towards those of this one, by the share of it that was taken.
  void take(Eigen::VectorXd solved, double taken);
  void forget() { reactions_.resize(0); }

  bool are_known() const { return reactions_.size() > 0; }
  /// By what internal forces, less the external ones, differ from the reactions; zero while these are not known.
  Eigen::VectorXd imbalance(const Eigen::VectorXd& balance) const;
  /// The size of loads with these reactions (see RowWeights).
  double load_size(const RowWeights& weights, const Eigen::VectorXd& loads, const Eigen::VectorXd& internal,
                   const Eigen::VectorXd& variable_forces) const;

 private:
  const Elimination& elimination_;
  const TangentSystem& tangent_;
  std::vector<int> eliminated_;
  Eigen::VectorXd reactions_;  ///< zero at free unknowns
};

/// How far a state is from balance: `residual` at the reduced unknowns and `left` at those that conditions hold (one a
/// degree of freedom).
struct Imbalance {
  const Eigen::VectorXd& residual;
  const Eigen::VectorXd& left;
};

/// By all criteria, with the larger of both. `load`: the size of the loads; `at_supports`: what else is left there;
/// `is_rounding`: whether the residual is no more than that.
ConvergenceCriterion::Measure measure(const ConvergenceCriterion& criterion, const ReferenceForces& reference,
                                      const RowWeights& weights, const Imbalance& imbalance, double load,
                                      double at_supports = 0.0, bool is_rounding = false);

}  // namespace comma::solver
