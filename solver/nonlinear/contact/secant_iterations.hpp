// Iterations in which penalties that rub between nodes follow the slip before: one linear solve each.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/contact_points.hpp"
#include "solver/nonlinear/contact/faced_contact.hpp"

namespace comma::solver {

/// Where the nodes are when points are faced.
struct ContactGeometry {
  std::vector<Eigen::Vector3d> places;
  double time = 0.0, margin = 0.0;
};

/// What Code_Aster 17.3 does iteration by iteration for discrete penalties with friction, so that figures of a
/// criterion that is loose are the same: gaps press by their penalty, and friction acts by its secant (see
/// secant_friction.hpp) wherever a point was closed one iteration before. A step begins with one solve in which contact
/// forces stay.
class SecantIterations {
 public:
  /// Keeps a pointer to its argument.
  explicit SecantIterations(FacedContact& contact) : contact_(&contact) {}

  /// Whether contacts of that kind are solved so.
  static bool suit(const ContactDefinition& definition);

  /// A step begins whose iterations are these, or others. `are_faced`: points have been faced before.
  void start_step(bool by_secants, bool are_faced);
  /// The step stands as it is: its forces stay for one solve of the next.
  void accept_step();

  /// Points are about to be faced anew, and have been: forces on rows go with their points.
  void before_facing();
  void after_facing();
  /// Another geometry within a step acts from the next linearisation on, since the solve before is still that of the
  /// last one. Whether it is kept until then.
  bool keeps(Positions positions, double time, double margin);
  std::optional<ContactGeometry> take_kept();

  /// After a correction that has led to u: statuses, multipliers and forces are what secants say there. `faced_anew`:
  /// on another geometry. Returns the number of points whose status changed.
  int linearise(const Eigen::VectorXd& u, bool faced_anew);
  /// Whether friction has acted wherever points are closed.
  bool may_end() const;
  /// The linear solve with the forces at hand has taken displacements from `before` to `after`.
  void note_solved(const Eigen::VectorXd& before, const Eigen::VectorXd& after);
  /// The residual of an iteration, as a share of the loads.
  void note_residual(double share) { last_residual_ = share; }

  /// Whether the next solve is the one that leaves contact forces as they were.
  bool predicts() const { return predicts_; }
  void end_prediction() { predicts_ = false; }
  /// Forces of the last linear solve: on the rows, and on all degrees of freedom.
  const Eigen::VectorXd& held() const { return held_; }
  const Eigen::VectorXd& solved() const { return solved_; }

 private:
  /// A point that slides, in the next solve.
  struct Relief {
    std::size_t point = 0;
    double stiffness = 0.0;  ///< what its secant is relieved of along the slip, a force a length
    Eigen::Vector2d along;   ///< the slip, of length one
    double shear = 0.0;      ///< a force
  };

  void begin();
  void take_solved_gaps(Eigen::VectorXd& jumps) const;
  ContactStatus take_secant(std::size_t p, const Eigen::VectorXd& jumps, bool accelerated);
  std::vector<Eigen::Vector3d> forces_of_points(const Eigen::VectorXd& on_rows) const;
  Eigen::VectorXd forces_on_rows(const std::vector<Eigen::Vector3d>& of_points) const;

  FacedContact* contact_;
  /// One a point: closed at the end of the last step, when this one began, one linearisation before; whether friction
  /// acts.
  std::vector<char> end_closed_, began_closed_, was_closed_, rubs_;
  int linearisations_ = 0;  ///< in the step
  std::vector<Relief> reliefs_;
  double last_residual_ = 1.0;  ///< as a share of the loads
  bool predicts_ = false;
  Eigen::VectorXd carried_;  ///< forces of the last step, on all degrees of freedom; empty: none
  Eigen::VectorXd held_;     ///< where rows are new, on the same points
  Eigen::VectorXd solved_;
  Eigen::VectorXd shears_;  ///< friction where the last linear solve began, on all degrees of freedom
  std::vector<Eigen::Vector3d> held_of_points_;  ///< while points are faced anew
  std::optional<ContactGeometry> kept_;
};

}  // namespace comma::solver
