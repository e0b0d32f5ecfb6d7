// Newton's method on the mixed problem of contact on its own rows.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact_law/condensed_problem.hpp"
#include "solver/contact_law/interpolated_step.hpp"
#include "solver/contact_law/nodal_step.hpp"
#include "solver/contact_law/smoothed_contact.hpp"
#include "solver/unilateral/schur_complement.hpp"

namespace comma::solver {

/// Those that Newton's method begins with.
const Eigen::VectorXd& first_jumps(const CondensedProblem& problem);
/// Multipliers, statuses, and the jumps and forces on the rows that go with them.
struct CondensedPlace {
  CondensedState state;
  Eigen::VectorXd jumps, forces;
};

bool has_penalty(const CondensedProblem& problem);

/// Ways from one place to a solution. They begin where the one before has ended; `iterations` count on. Multipliers and
/// statuses are those of `state`.
class CondensedNewton {
 public:
  /// What closed points do along the surface.
  enum class Rubbing : std::uint8_t { by_law, never_slides };
  /// With friction, whether to stop where two iterations have brought what is left of the equations no nearer to zero.
  enum class Patience : std::uint8_t { to_the_end, short_of_growth };

  CondensedNewton(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state);

  CondensedPlace place() const { return {state_, jumps_, forces_}; }
  void go_to(const CondensedPlace& place);
  /// Jumps as the multipliers have them: those that bodies come to under their forces, and at penalties those that ask
  /// for these forces.
  void balance_jumps();
  /// Laws that are smooth at first need no statuses. On nodes augmentations are not in the solution, and those of the
  /// bodies lead there.
  bool follow_smoothed(int& iterations, Augmentations augmentations);
  /// By fixed-point iterations (see relaxation.hpp).
  bool relax();
  /// Iterates until statuses stay and nothing is left of the equations; counts on.
  bool settle(Rubbing rubbing, int& iterations, Patience patience = Patience::to_the_end);
  /// Newton's method on statuses, jumps and multipliers together: each correction is halved until less is left of the
  /// equations with the statuses that it brings (a damped semismooth method; T. De Luca, F. Facchinei, C. Kanzow,
  /// Mathematical Programming 75, 1996).
  bool descend(int& iterations);
  void correct_once();
  /// The statuses that the law asks for after one correction.
  void correct_statuses();

  /// How much of friction there is from now on.
  void take_friction(double share) { friction_share_ = share; }
  /// The same of penalties. Forces stay: jumps of penalised points become those that go with them.
  void take_penalties(double share);

  const Eigen::VectorXd& forces() const { return forces_; }
  /// Whether jumps are those of bodies that nothing holds.
  bool is_far() const;
  /// Whether the present state is one that bodies come to: no farther than some times the nearest one that was met.
  bool stays_near() const;
  /// Whether the last attempt ended for want of patience.
  bool was_led_away() const { return led_away_; }
  /// Whether a linear system was not solved.
  bool is_lost() const { return is_lost_; }

 private:
  void take_jumps_of_penalties();
  static void let_multipliers_bear_penalties(double stiffness, ContactLaw& law);
  ContactLaw law_of(std::size_t p) const;
  /// The share of the correction that was taken.
  double correct_partly();
  /// The statuses that the law asks for, and what is left of the equations with them.
  void adapt_statuses();
  ContactStatus restricted(ContactStatus status, const CondensedPoint& point) const;
  int multiplier_index(int node, int component) const { return node * problem_.components + component; }
  bool is_smooth(int node) const { return !problem_.smooth.empty() && problem_.smooth[static_cast<std::size_t>(node)]; }
  Eigen::Vector3d multiplier_at(const CondensedPoint& point) const {
    return solver::multiplier_at(problem_, state_, point);
  }
  Eigen::Vector3d jump_at(const CondensedPoint& point) const;
  ContactLawValue law_at(std::size_t p) const;
  /// A multiplier is zero, without more ado, where each of its points lies on its node and is open, or does not rub.
  void number_unknowns();
  void add_row(int row);
  void require_columns();
  /// One step of Newton's method for the jumps of closed points and springs and for the multipliers.
  void correct();
  /// The same with the multipliers eliminated point by point: half the unknowns. False where a law leaves its
  /// multiplier open.
  bool correct_at_nodes();
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
  /// Forces, and what is left of the equations, at the present multipliers and jumps.
  void evaluate();
  void measure(const LawBalance& law, const Eigen::VectorXd& balanced);
  double largest_pressure() const;
  /// What forces of one sign could do to a jump: jumps are exact to some roundings of it.
  double largest_response() const;
  bool is_solved();
  /// Of lengths at a point that are differences of pressures or shears over an augmentation, which may be small beside
  /// the stiffness of the bodies.
  Eigen::Vector3d law_rounding(std::size_t p) const;
  /// The largest of what that makes of the equations of a multiplier.
  double law_rounding() const;
  /// Where corrections bring no more.
  bool is_rounding() const;
  /// Whether a status that the law asks for differs from the present one by more than rounding.
  bool is_meant(std::size_t p, ContactStatus now, ContactStatus wanted) const;
  ContactStatus wanted_status(std::size_t p) const;
  bool is_cycle(const std::vector<ContactStatus>& next);
  bool update_statuses();

  SchurComplement& schur_;
  const CondensedProblem& problem_;
  CondensedState& state_;
  Eigen::VectorXd jumps_;
  Eigen::VectorXd forces_;
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
  double remainder_ = 0.0;  ///< what is left of all equations, by the root of squares (a length)
  double last_residual_ = 0.0;
  double scale_ = 0.0;
  double nearest_ = std::numeric_limits<double>::infinity();  ///< the least scale that was met
  double pressure_scale_ = 0.0;
  int same_statuses_ = 0;
  bool one_at_a_time_ = false;
  bool led_away_ = false;
  bool is_lost_ = false;
  Rubbing rubbing_ = Rubbing::by_law;
  double friction_share_ = 1.0, penalty_share_ = 1.0;
  bool pressures_by_bodies_ = false,
       shears_by_bodies_ = false;  ///< whose augmentations are those of the bodies, not of the law
  std::vector<PointStiffness> bodies_;
  std::map<std::vector<ContactStatus>, double> visited_;  ///< what was left with them
};

}  // namespace comma::solver
