// The mixed formulation of contact (R5.03.52) within Newton's iterations: points, multipliers, forces.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/contact/doubts.hpp"
#include "solver/contact_law/condensed_contact.hpp"
#include "solver/contact_law/contact_memory.hpp"
#include "solver/nonlinear/contact/contact_augmentations.hpp"
#include "solver/nonlinear/contact/contact_compliance.hpp"
#include "solver/nonlinear/contact/contact_penalties.hpp"
#include "solver/nonlinear/contact/faced_contact.hpp"
#include "solver/nonlinear/contact/rubbing_iterations.hpp"
#include "solver/nonlinear/contact/secant_iterations.hpp"
#include "solver/nonlinear/iterations/tangent_system.hpp"
#include "solver/nonlinear/static_analysis.hpp"
#include "solver/unilateral/multiplier_course.hpp"

namespace comma::solver {

/// Discrete contact that is more than inequalities (see is_condensed) is the same with points at the slave nodes and
/// forces for pressures. Pressures live at the slave nodes of each zone, the law holds at the integration points of the
/// slave faces. An iteration of Newton's method on the bodies solves the contact law exactly, on the contact rows
/// alone:
///     K dq = T^T (f_ext - f_int(u)) + A^T w t(multipliers, jumps),   jumps = base + R u
/// with A = R T. Bodies that nothing but contact holds get springs for the factorisation, which come off again on the
/// contact rows.
class MixedContact {
 public:
  /// What an iteration of Newton's method on the bodies does with contact. `settled`: solves its law exactly. `joint`:
  /// one linear solve with statuses and geometry at hand, which change after it. `secant`: see SecantIterations.
  /// `rubbing`: see RubbingIterations.
  enum class Iterations : std::uint8_t { settled, joint, secant, rubbing };

  /// Keeps references to its arguments. `support`: the reduced unknowns that contact can touch, rising.
  MixedContact(const ContactDefinition& definition, const Model& model, const DofMap& dofs,
               const Elimination& elimination, TangentSystem& tangent, Counters& counters, std::vector<int> support);

  /// A step of that duration begins at u: slips are counted from there, and multipliers are expected to go on as in the
  /// step before.
  void start_step(const Eigen::VectorXd& u, double duration);
  /// The step from one instant to another stands as it is.
  void accept_step(double from, double instant);
  /// Pressures, statuses and penalties as they are before a step, and back to them when it fails; points must be faced
  /// anew then.
  void remember() { remembered_ = {contact_.state, penalties_.state(), started_, resumed_, secants_}; }
  void restore();
  /// See resumed_contact.hpp.
  std::shared_ptr<const ContactMemory> memory() const;
  /// Starts from displacements u, and goes on from what an earlier computation remembers (may be null); before any
  /// point is faced.
  void begin_at(const Eigen::VectorXd& u, std::shared_ptr<const ContactMemory> memory);
  /// Faces the points anew. `positions`: where the nodes are now.
  void pair(Positions positions, double time, double margin = 0.0);
  /// Those that Code_Aster has, so that figures of a criterion that is loose are the same: joint ones for standard
  /// contact without friction by Newton's method alone (`whole_newton`), secants for penalties that rub between nodes,
  /// rubbing ones for standard friction by Newton's method alone with a loose criterion (RESI_FROT).
  Iterations iterations_like_code_aster(bool whole_newton) const;
  void iterate(Iterations iterations);
  /// These unknowns are eliminated, without reactions (AFFE_CHAR_CINE): held_imbalance() leaves them out.
  void set_eliminated(std::vector<int> dofs) { eliminated_ = std::move(dofs); }
  /// Whether `correct` takes one step with the statuses at hand, and `linearise` gives the next.
  bool is_linear() const { return contact_.problem.one_step; }
  bool is_joint() const { return iterations_ == Iterations::joint; }
  bool is_secant() const { return iterations_ == Iterations::secant; }
  bool is_rubbing() const { return iterations_ == Iterations::rubbing; }
  /// After a correction that has led to u: statuses and forces are what the law says there, of joint iterations where
  /// points are faced anew. Returns the number of points whose status changed.
  int linearise(const Eigen::VectorXd& u, double time);
  /// After `linearise`, which has changed so many statuses: whether a residual small enough ends the iterations. Joint
  /// ones ask for none, and nodes that had moved by no more than RESI_GEOM since points were faced before (see
  /// geometry_change); others say what they ask for.
  bool may_end(int changes) const;
  /// Of rubbing iterations (see RubbingIterations).
  void begin_again() { rubbing_.begin_again(); }
  int change_points(const Eigen::VectorXd& u) { return rubbing_.change_points(u); }
  /// The largest forces at unknowns that conditions hold which the last linear solve did not balance.
  struct HeldImbalance {
    double counted = 0.0;  ///< where there are reactions
    double largest = 0.0;  ///< of all: it counts among the loads
  };
  /// By secants and rubbing ones: a reaction is that of the solve. `balance`: of all loads but those of contact, one a
  /// degree of freedom.
  HeldImbalance held_imbalance(const Eigen::VectorXd& balance) const;
  /// The residual of an iteration, as a share of the loads; negative where there are none.
  void note_residual(double share) {
    if (share >= 0.0) secants_.note_residual(share);
  }
  /// Whether points overlap at u that wait for the geometry at the end of the step (see hold_back_points): points must
  /// be faced anew.
  bool leaves_overlap(const Eigen::VectorXd& u) const;
  /// After a new factorisation.
  void forget() { compliance_.forget(); }

  /// Forces on the reduced unknowns.
  Eigen::VectorXd forces() const;
  /// What of them the next correction starts without: by secants all that they exceed those of the last linear solve
  /// by, since a stiff penalty asks for forces out of all proportion at first.
  Eigen::VectorXd forces_left_out() const;

  /// Takes the reduced unknowns from `before` to `corrected`, which balances the present forces, and on to where the
  /// law of contact holds too. `offset`: g of u = T q + g. Returns the number of points whose status changed. Throws
  /// Error `contact-cycling`, `contradictory-conditions`.
  int correct(const Eigen::VectorXd& before, const Eigen::VectorXd& offset, Eigen::VectorXd& corrected);

  int closed_count() const { return contact_.closed_count(); }
  /// Whether each point is closed, in the order of the points.
  std::vector<char> closed_points() const { return contact_.closed_points(); }
  /// The largest depth of a point at u (a length), or of one that has a penalty.
  double penetration(const Eigen::VectorXd& u, bool of_penalties = false) const;
  const std::vector<ContactPoint>& points() const { return contact_.points(); }

  const ContactPenalties& penalties() const { return penalties_; }
  /// See ContactPenalties.
  void limit_depth(double depth, double most_stiffening) { penalties_.limit_depth(depth, most_stiffening); }
  bool stiffen_penalties(const Eigen::VectorXd& u) { return penalties_.stiffen(u); }
  bool adapt_penalties(const Eigen::VectorXd& u);

  /// Of a step that has converged at u (see contact_doubts.hpp). Costs a solve where there are penalties.
  void note_doubts(const Eigen::VectorXd& u, ContactDoubts& doubts);
  /// Of the last step: motions of bodies that nothing holds, not even the points that are closed.
  void note_loose_bodies(const Eigen::VectorXd& u, ContactDoubts& doubts) const;
  /// See contact_doubts.hpp; 0 where no force has been computed.
  std::vector<double> pushed_back(const Eigen::VectorXd& u);

  /// At u, for those who make fields and alarms of it; keeps references to this and to u.
  SolvedContact solved(const Eigen::VectorXd& u) const { return {contact_, u, contact_.jumps(u)}; }

 private:
  struct Remembered {
    CondensedState state;
    ContactPenalties::State penalties;
    bool started = false;
    std::shared_ptr<const ContactMemory> resumed;
    SecantIterations secants;
  };

  void face(Positions positions, double time, double margin);
  void start_forces(double time);
  int face_and_linearise(const Eigen::VectorXd& u, double time);
  void start_statuses(const Eigen::VectorXd& jumps);
  void close_nearest(const Eigen::VectorXd& jumps);
  void close_slides();
  void share_friction();
  CondensedSolution solve_law();
  bool is_faced_again() const;
  void hold_points();
  void hold_back_points();
  void check_blocked_points(const Eigen::VectorXd& jumps) const;
  void update_compliance();
  double displacement_of_surfaces(const Eigen::VectorXd& u) const;
  void begin_near(const Eigen::VectorXd& before, const Eigen::VectorXd& offset);
  std::optional<double> settle(const Eigen::VectorXd& before, const Eigen::VectorXd& offset, Eigen::VectorXd& forces,
                               Eigen::VectorXd& corrected);

  FacedContact contact_;
  TangentSystem& tangent_;
  Counters& counters_;
  std::vector<int> eliminated_;

  ContactAugmentations augmentations_;
  ContactPenalties penalties_;
  ContactCompliance compliance_;
  ActiveSetMemory memory_;
  NearInverse near_inverse_;
  InterpolatedSolver interpolated_solver_;
  ShareSearch share_search_;

  Iterations iterations_ = Iterations::settled;
  SecantIterations secants_;
  RubbingIterations rubbing_;
  Eigen::VectorXd faced_at_;  ///< u where joint iterations faced the points; at first the beginning of the step
  double geometry_change_ = 0.0;

  bool started_ = false;
  std::shared_ptr<const ContactMemory> resumed_;  ///< null once statuses have started from it
  std::optional<Remembered> remembered_;
  bool rubs_by_shears_ = false;         ///< see CondensedSolution::by_shears
  std::vector<ContactDoubt> bridged_;   ///< gaps that points of slides are closed across
  Eigen::VectorXd start_;               ///< multipliers when the step began
  MultiplierCourse course_;             ///< of accepted steps
  Eigen::VectorXd rates_;               ///< of multipliers, in the last step that was accepted
  std::vector<char> began_closed_;      ///< points, when the step or its geometry began
  bool step_begins_ = false;            ///< and no point has been faced in it
  std::vector<std::size_t> held_back_;  ///< points that may not close yet
};

}  // namespace comma::solver
