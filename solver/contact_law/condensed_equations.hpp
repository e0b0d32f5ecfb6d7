// The mixed problem of contact on its own rows at a state: what is left of it, and one step of Newton's method.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact_law/condensed_problem.hpp"
#include "solver/contact_law/interpolated_step.hpp"
#include "solver/contact_law/nodal_step.hpp"
#include "solver/contact_law/smoothed_contact.hpp"
#include "solver/unilateral/schur_complement.hpp"

namespace comma::solver {

/// The equations of condensed_problem.hpp with the statuses of a state. Unknown are its multipliers and the jumps of
/// closed points and springs; the other jumps are those that bodies come to.
class CondensedEquations {
 public:
  /// `state` stays where it is; its multipliers are written.
  CondensedEquations(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state);

  const Eigen::VectorXd& jumps() const { return jumps_; }
  const Eigen::VectorXd& forces() const { return forces_; }
  void go_to(Eigen::VectorXd jumps, Eigen::VectorXd forces);
  void take_jumps(Eigen::VectorXd jumps) { jumps_ = std::move(jumps); }
  /// Jumps as the multipliers have them: those that bodies come to under their forces, and at penalties those that ask
  /// for these forces.
  void balance_jumps();
  /// Those that bodies come to under the present forces.
  void take_balanced_jumps();

  /// How much of friction there is from now on.
  void take_friction(double share) { friction_share_ = share; }
  /// The same of penalties. Forces stay: jumps of penalised points become those that go with them.
  void take_penalties(double share);
  /// By these stiffnesses (one a point) in place of what the laws have, penalties aside.
  void augment_shears(std::vector<PointStiffness> bodies);
  void augment_pressures_and_shears(std::vector<PointStiffness> bodies);
  void augment_by_laws();

  /// One step of Newton's method for jumps and multipliers.
  void correct();
  /// Of problems of one step: the forces that it has been solved with; empty where nothing was unknown.
  const Eigen::VectorXd& solved_forces() const { return solved_forces_; }
  /// Forces, and what is left of the equations, at the present multipliers and jumps.
  void evaluate();

  /// What evaluate() found to be left: the largest, and the root of squares of all (a length).
  double residual() const { return residual_; }
  double remainder() const { return remainder_; }
  /// What jumps are measured by (a length).
  double scale() const { return scale_; }
  /// Whether a linear system was not solved.
  bool is_lost() const { return is_lost_; }
  void forget_loss() { is_lost_ = false; }
  /// Where corrections bring no more.
  bool is_rounding() const;

  bool is_nodal() const { return is_nodal_; }
  ContactLaw law_of(std::size_t p) const;
  Eigen::Vector3d multiplier_at(const CondensedPoint& point) const {
    return solver::multiplier_at(problem_, state_, point);
  }
  Eigen::Vector3d jump_at(const CondensedPoint& point) const { return at_point(point, jumps_); }
  double largest_pressure() const;
  /// Of lengths at a point that are differences of pressures or shears over an augmentation, which may be small beside
  /// the stiffness of the bodies.
  Eigen::Vector3d law_rounding(std::size_t p) const;

 private:
  void take_jumps_of_penalties();
  static void let_multipliers_bear_penalties(double stiffness, ContactLaw& law);
  ContactLawValue law_at(std::size_t p) const;
  /// A multiplier is zero, without more ado, where each of its points lies on its node and is open, or does not rub.
  void number_unknowns();
  void add_row(int row);
  void require_columns();
  /// The step with the multipliers eliminated point by point: half the unknowns. False where a law leaves its
  /// multiplier open.
  bool correct_at_nodes();
  void take_solved_forces(const Eigen::VectorXd& changes);
  /// Many rows by products with the compliance; where these lead nowhere and for few rows, directly. Nothing where that
  /// takes too long as well.
  std::optional<Eigen::VectorXd> solved(NodalStep& step, const Eigen::VectorXd& balance);
  /// What jumps of unknown rows exceed those that go with the forces by.
  Eigen::VectorXd unbalanced_jumps();
  /// Many rows by products with the compliance where these lead anywhere.
  Eigen::VectorXd solved(const InterpolatedStep& equations, const Eigen::VectorXd& balance);
  void add_point(std::size_t p, InterpolatedStep& equations, Eigen::VectorXd& balance);
  void add_traction_derivatives(const CondensedPoint& point, const ContactLawValue& value,
                                InterpolatedStep& equations) const;
  void add_laws(const CondensedPoint& point, const ContactLawValue& value, InterpolatedStep& equations,
                Eigen::VectorXd& balance) const;
  /// The jumps that go with the present forces.
  Eigen::VectorXd balanced_jumps();
  /// What is left of the law at a multiplier, and what a length is measured by there.
  struct LawBalance {
    Eigen::VectorXd residual, weight;
    Eigen::VectorXd share_weight;  ///< by which a share is known to its own rounding
    Eigen::VectorXd open;          ///< augmentation of open points, a pressure over a length, or 0
  };
  void measure(const LawBalance& law, const Eigen::VectorXd& balanced);
  /// What forces of one sign could do to a jump: jumps are exact to some roundings of it.
  double largest_response() const;
  /// The largest of what the rounding of lengths makes of the equations of a multiplier.
  double law_rounding() const;

  SchurComplement& schur_;
  const CondensedProblem& problem_;
  CondensedState& state_;
  Eigen::VectorXd jumps_;
  Eigen::VectorXd forces_;
  Eigen::VectorXd solved_forces_;
  const bool is_nodal_;
  const int direct_rows_;
  NearInverse own_near_inverse_;
  InterpolatedSolver own_interpolated_solver_;
  Eigen::VectorXd balanced_forces_, balanced_;
  std::vector<int> row_unknowns_;         ///< unknown of a row of the Schur complement, or -1
  std::vector<int> multiplier_unknowns_;  ///< the same of a multiplier
  std::vector<int> unknown_rows_;
  int unknowns_ = 0;
  double residual_ = 0.0;
  double remainder_ = 0.0;
  double scale_ = 0.0;
  bool is_lost_ = false;
  double friction_share_ = 1.0, penalty_share_ = 1.0;
  bool pressures_by_bodies_ = false,
       shears_by_bodies_ = false;  ///< whose augmentations are those of the bodies, not of the law
  std::vector<PointStiffness> bodies_;
};

}  // namespace comma::solver
