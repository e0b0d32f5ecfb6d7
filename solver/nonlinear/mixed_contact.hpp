// The mixed formulation of contact (R5.03.52) within Newton's iterations: points, multipliers, forces.
#pragma once

#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/contact/doubts.hpp"
#include "solver/contact_law/adapted_penalties.hpp"
#include "solver/contact_law/condensed_contact.hpp"
#include "solver/contact_law/contact_memory.hpp"
#include "solver/contact_law/contact_rows.hpp"
#include "solver/nonlinear/solved_contact.hpp"
#include "solver/nonlinear/static_analysis.hpp"
#include "solver/nonlinear/tangent_system.hpp"
#include "solver/unilateral/multiplier_course.hpp"
#include "solver/unilateral/schur_complement.hpp"

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
  /// one linear solve with statuses and geometry at hand, which change after it. `secant`: the same with the geometry
  /// held, friction of penalties being known by the slip before (see secant_friction.hpp). `rubbing`: with the geometry
  /// and closed points held; friction alone changes after it, by shares of its limit.
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
  void remember() { remembered_ = {state_, penalties_, adapted_, started_, resumed_, secants_}; }
  void restore() { std::tie(state_, penalties_, adapted_, started_, resumed_, secants_) = remembered_; }
  /// What a later computation must know of a step that has been accepted; null where its fields say all.
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
  bool is_linear() const { return problem_.one_step; }
  bool is_joint() const { return iterations_ == Iterations::joint; }
  bool is_secant() const { return iterations_ == Iterations::secant; }
  bool is_rubbing() const { return iterations_ == Iterations::rubbing; }
  /// After a correction that has led to u: statuses and forces are what the law says there, of joint iterations where
  /// points are faced anew. Returns the number of points whose status changed.
  int linearise(const Eigen::VectorXd& u, double time);
  /// After `linearise`, which has changed so many statuses: whether a residual small enough ends the iterations. Joint
  /// ones ask for none, and nodes that had moved by no more than RESI_GEOM since points were faced before (see
  /// geometry_change); secants that friction has acted wherever points are closed; rubbing ones that unknowns have
  /// changed by no more than RESI_FROT of the largest.
  bool may_end(int changes) const;
  /// Rubbing iterations begin, again and again, where the step does, without shears; the pressures at hand weigh those
  /// of the first.
  void begin_again();
  /// Of rubbing iterations that have ended at u: opens points that pull, and closes those that overlap. How many.
  int change_points(const Eigen::VectorXd& u);
  /// The largest forces at unknowns that conditions hold which the last linear solve did not balance.
  struct HeldImbalance {
    double counted = 0.0;  ///< where there are reactions
    double largest = 0.0;  ///< of all: it counts among the loads
  };
  /// By secants and rubbing ones: a reaction is that of the solve. `balance`: of all loads but those of contact, one a
  /// degree of freedom.
  HeldImbalance held_imbalance(const Eigen::VectorXd& balance) const;
  /// The residual of an iteration, as a share of the loads.
  void note_residual(double share);
  /// Whether points overlap at u that wait for the geometry at the end of the step (see hold_back_points): points must
  /// be faced anew.
  bool leaves_overlap(const Eigen::VectorXd& u) const;
  /// After a new factorisation.
  void forget();

  /// Forces on the reduced unknowns.
  Eigen::VectorXd forces() const;
  /// What of them the next correction starts without: by secants all that they exceed those of the last linear solve
  /// by, since a stiff penalty asks for forces out of all proportion at first.
  Eigen::VectorXd forces_left_out() const;

  /// Takes the reduced unknowns from `before` to `corrected`, which balances the present forces, and on to where the
  /// law of contact holds too. `offset`: g of u = T q + g. Returns the number of points whose status changed. Throws
  /// Error `contact-cycling`, `contradictory-conditions`.
  int correct(const Eigen::VectorXd& before, const Eigen::VectorXd& offset, Eigen::VectorXd& corrected);

  int closed_count() const;
  /// Whether each point is closed, in the order of the points.
  std::vector<char> closed_points() const;
  /// Whether a zone gives way (ALGO_CONT='PENALISATION').
  bool has_penalties() const;
  /// From now on penalties are raised, at most by a factor, until no point is deeper than this (a length).
  void limit_depth(double depth, double most_stiffening) { penalties_.limit_depth(depth, most_stiffening); }
  /// The largest depth of a point at u (a length), or of one that has a penalty.
  double penetration(const Eigen::VectorXd& u, bool of_penalties = false) const;
  const std::vector<ContactPoint>& points() const { return rows_.points(); }

  /// Raises the penalty of zones where points lie deeper at u than allowed (`limit_depth`), or points that stick slip
  /// by more (MixedZone::largest_slip); whether there were any. Throws Error `no-convergence` where that does not help.
  bool stiffen_penalties(const Eigen::VectorXd& u);
  /// Adapts the penalties of points to their depths at u (MixedZone::adapts_penalty), once. Whether any changed.
  bool adapt_penalties(const Eigen::VectorXd& u);
  /// See AdaptedPenalties.
  bool began_adapted() const { return adapted_.began_adapted(); }

  /// Of a step that has converged at u (see contact_doubts.hpp). Costs a solve where there are penalties.
  void note_doubts(const Eigen::VectorXd& u, ContactDoubts& doubts);
  /// Of the last step: motions of bodies that nothing holds, not even the points that are closed.
  void note_loose_bodies(const Eigen::VectorXd& u, ContactDoubts& doubts) const;
  /// See contact_doubts.hpp; 0 where no force has been computed.
  std::vector<double> pushed_back(const Eigen::VectorXd& u);

  /// At u, for those who make fields and alarms of it; keeps references to this and to u.
  SolvedContact solved(const Eigen::VectorXd& u) const;

 private:
  /// Of iterations by secants.
  struct Secants {
    /// A point that slides, in the next solve.
    struct Relief {
      std::size_t point = 0;
      double stiffness = 0.0;  ///< what its secant is relieved of along the slip, a force a length
      Eigen::Vector2d along;   ///< the slip, of length one
      double shear = 0.0;      ///< a force
    };
    /// One a point: closed at the end of the last step, when this one began, one linearisation before; whether friction
    /// acts.
    std::vector<char> end_closed, began_closed, was_closed, rubs;
    int linearisations = 0;  ///< in the step
    std::vector<Relief> reliefs;
    double last_residual = 1.0;  ///< as a share of the loads
    bool predicts = false;       ///< the step begins: contact forces stay for one solve
    Eigen::VectorXd carried;     ///< these, on all degrees of freedom; empty: none
    Eigen::VectorXd held;    ///< forces on the rows in the last linear solve; where these are new, on the same points
    Eigen::VectorXd solved;  ///< those of the last linear solve, on all degrees of freedom
    Eigen::VectorXd shears;  ///< friction where that began, on all degrees of freedom
  };

  struct Rubbing {
    /// Displacements in the step, pressures and shares of friction after the iteration before; empty: all zero.
    Eigen::VectorXd last;
    double change = 0.0;     ///< of the largest of these in the last iteration
    Eigen::VectorXd solved;  ///< forces of the last linear solve, on all degrees of freedom
  };

  struct Geometry {
    std::vector<Eigen::Vector3d> places;  ///< of the nodes
    double time = 0.0, margin = 0.0;
  };

  void face(Positions positions, double time, double margin);
  void start_forces(double time);
  int face_and_linearise(const Eigen::VectorXd& u, double time);
  int linearise_secants(const Eigen::VectorXd& u);
  bool rubs_loosely() const;
  int linearise_friction(const Eigen::VectorXd& u);
  void note_friction(const Eigen::VectorXd& u, const Eigen::VectorXd& shares);
  ContactLaw law_by_shares(std::size_t p, double pressure) const;
  CondensedSolution step_by_shares();
  void note_coarse_friction(ContactDoubts& doubts) const;
  void take_solved_gaps(Eigen::VectorXd& jumps) const;
  ContactStatus take_secant(std::size_t p, const Eigen::VectorXd& jumps, bool accelerated);
  std::vector<Eigen::Vector3d> forces_of_points(const Eigen::VectorXd& on_rows) const;
  Eigen::VectorXd forces_on_rows(const std::vector<Eigen::Vector3d>& of_points) const;
  void carry_contact();
  void begin_secants();
  bool can_predict() const;
  void note_solved(const Eigen::VectorXd& before, const Eigen::VectorXd& after);
  void start_statuses(const Eigen::VectorXd& jumps);
  std::vector<ZoneMemory> zone_definitions() const;
  RememberedPoint remembered(std::size_t p) const;
  std::vector<char> held_points();
  void close_nearest(const Eigen::VectorXd& jumps);
  void close_slides();
  void apply_penalties();
  bool adapts(std::size_t zone) const;
  void share_friction();
  void add_natural_augmentation();
  double augmentation_of(const ContactZone& zone) const;
  bool lower_augmentation();
  bool open_by_gaps();
  CondensedSolution solve_law();
  double stiffness_at(std::size_t p) const;
  double resistance_at(std::size_t p) const;
  bool is_faced_again() const;
  void hold_points();
  void hold_back_points();
  void check_blocked_points(const Eigen::VectorXd& jumps) const;
  std::vector<int> row_keys() const;
  void update_schur();
  double displacement_of_surfaces(const Eigen::VectorXd& u) const;
  Eigen::VectorXd pushed_by(const Eigen::VectorXd& contact_forces);
  void begin_near(const Eigen::VectorXd& before, const Eigen::VectorXd& offset);
  std::optional<double> settle(const Eigen::VectorXd& before, const Eigen::VectorXd& offset, Eigen::VectorXd& forces,
                               Eigen::VectorXd& corrected);
  Eigen::VectorXd jumps(const Eigen::VectorXd& u) const { return rows_.jumps(u); }

  const ContactDefinition& definition_;
  const Mesh& mesh_;
  const DofMap& dofs_;
  const Elimination& elimination_;
  TangentSystem& tangent_;
  Counters& counters_;
  const std::vector<int> support_;

  ContactRows rows_;
  RaisedPenalties penalties_;
  AdaptedPenalties adapted_;
  std::shared_ptr<const ContactMemory> resumed_;  ///< null once statuses have started from it
  ActiveSetMemory memory_;
  NearInverse near_inverse_;
  InterpolatedSolver interpolated_solver_;
  ShareSearch share_search_;
  CondensedProblem problem_;
  CondensedState state_;
  bool started_ = false;
  std::vector<int> eliminated_;
  std::vector<ContactDoubt> bridged_;  ///< gaps that points of slides are closed across
  /// Of what is given, between nodes: lowered in a step where nothing else leads to a solution.
  double augmentation_share_ = 1.0;
  bool opens_by_gaps_ = false;   ///< points between nodes that have penalties: for the rest of a step
  bool rubs_by_shears_ = false;  ///< see CondensedSolution::by_shears
  std::tuple<CondensedState, RaisedPenalties, AdaptedPenalties, bool, std::shared_ptr<const ContactMemory>, Secants>
      remembered_;
  Iterations iterations_ = Iterations::settled;
  Secants secants_;
  Rubbing rubbing_;
  std::optional<Geometry> next_geometry_;
  std::size_t spring_count_ = 0;
  Eigen::VectorXd forces_;  ///< on the rows
  Eigen::VectorXd reference_;
  Eigen::VectorXd faced_at_;  ///< u where `linearise` faced the points; at first the beginning of the step
  double geometry_change_ = 0.0;
  Eigen::VectorXd start_;               ///< multipliers when the step began
  MultiplierCourse course_;             ///< of accepted steps
  Eigen::VectorXd rates_;               ///< of multipliers, in the last step that was accepted
  std::vector<char> began_closed_;      ///< points, when the step or its geometry began
  bool step_begins_ = false;            ///< and no point has been faced in it
  std::vector<std::size_t> held_back_;  ///< points that may not close yet
  std::unique_ptr<SchurComplement> schur_;
};

}  // namespace comma::solver
