// Newton's method on the mixed problem of contact on its own rows.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact_law/condensed_equations.hpp"

namespace comma::solver {

/// Multipliers, statuses, and the jumps and forces on the rows that go with them.
struct CondensedPlace {
  CondensedState state;
  Eigen::VectorXd jumps, forces;
};

/// Ways from one place to a solution. They begin where the one before has ended; `iterations` count on. Multipliers and
/// statuses are those of `state`.
class CondensedNewton {
 public:
  /// What closed points do along the surface.
  enum class Rubbing : std::uint8_t { by_law, never_slides };
  /// With friction, whether to stop where two iterations have brought what is left of the equations no nearer to zero.
  enum class Patience : std::uint8_t { to_the_end, short_of_growth };

  CondensedNewton(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state);

  CondensedPlace place() const { return {state_, equations_.jumps(), equations_.forces()}; }
  void go_to(const CondensedPlace& place);
  void balance_jumps() { equations_.balance_jumps(); }
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

  void take_friction(double share) { equations_.take_friction(share); }
  void take_penalties(double share) { equations_.take_penalties(share); }

  const Eigen::VectorXd& forces() const { return equations_.forces(); }
  const Eigen::VectorXd& solved_forces() const { return equations_.solved_forces(); }
  /// Whether the present state is one that bodies come to: no farther than some times the nearest one that was met.
  bool stays_near() const;
  /// Whether the last attempt ended for want of patience.
  bool was_led_away() const { return led_away_; }
  bool is_lost() const { return equations_.is_lost(); }

 private:
  /// The share of the correction that was taken.
  double correct_partly();
  /// The statuses that the law asks for, and what is left of the equations with them.
  void adapt_statuses();
  ContactStatus restricted(ContactStatus status, const CondensedPoint& point) const;
  /// Whether nothing is left of the equations, as far as they can be solved.
  bool is_solved();
  /// Whether a status that the law asks for differs from the present one by more than rounding.
  bool is_meant(std::size_t p, ContactStatus now, ContactStatus wanted) const;
  ContactStatus wanted_status(std::size_t p) const;
  bool is_cycle(const std::vector<ContactStatus>& next);
  bool update_statuses();

  SchurComplement& schur_;
  const CondensedProblem& problem_;
  CondensedState& state_;
  CondensedEquations equations_;
  double last_residual_ = 0.0;
  double nearest_ = std::numeric_limits<double>::infinity();  ///< the least scale that was met
  double pressure_scale_ = 0.0;
  int same_statuses_ = 0;
  bool one_at_a_time_ = false;
  bool led_away_ = false;
  Rubbing rubbing_ = Rubbing::by_law;
  std::map<std::vector<ContactStatus>, double> visited_;  ///< what was left with them
};

}  // namespace comma::solver
