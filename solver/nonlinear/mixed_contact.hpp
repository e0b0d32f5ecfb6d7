// The mixed formulation of contact (R5.03.52) within Newton's iterations: points, multipliers, forces.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/contact/contact_field.hpp"
#include "solver/contact/contact_points.hpp"
#include "solver/contact/doubts.hpp"
#include "solver/contact_law/condensed_contact.hpp"
#include "solver/contact_law/contact_memory.hpp"
#include "solver/contact_law/contact_rows.hpp"
#include "solver/fields/field.hpp"
#include "solver/nonlinear/static_analysis.hpp"
#include "solver/nonlinear/tangent_system.hpp"
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
  /// Keeps references to its arguments. `support`: the reduced unknowns that contact can touch, rising.
  MixedContact(const ContactDefinition& definition, const Model& model, const DofMap& dofs,
               const Elimination& elimination, TangentSystem& tangent, Counters& counters, std::vector<int> support);

  /// A step of that duration begins at u: slips are counted from there, and multipliers are expected to go on as in the
  /// step before.
  void start_step(const Eigen::VectorXd& u, double duration);
  void accept_step(double duration) { rates_ = (state_.multipliers - start_) / duration; }
  /// Pressures, statuses and penalties as they are before a step, and back to them when it fails; points must be faced
  /// anew then.
  void remember() { remembered_ = {state_, penalties_, started_}; }
  void restore() { std::tie(state_, penalties_, started_) = remembered_; }
  /// What a later computation must know of a step that has been accepted; null where its fields say all.
  std::shared_ptr<const ContactMemory> memory() const;
  /// Starts from displacements u, and goes on from what an earlier computation remembers (may be null); before any
  /// point is faced.
  void begin_at(const Eigen::VectorXd& u, std::shared_ptr<const ContactMemory> memory);
  /// Faces the points anew. `positions`: where the nodes are now.
  void pair(Positions positions, double time, double margin = 0.0);
  /// Whether statuses and geometry may change once an iteration of Newton's method on the bodies, instead of being
  /// settled within it: standard contact without friction.
  bool can_iterate_jointly() const;
  /// Whether they do: `correct` then takes one step with the statuses at hand, and `linearise` gives the next.
  void iterate_jointly(bool jointly) { problem_.one_step = jointly; }
  bool is_joint() const { return problem_.one_step; }
  /// Faces the points anew at u; statuses and forces are what the law says there. Returns the number of points whose
  /// status changed.
  int linearise(const Eigen::VectorXd& u, double time);
  /// Whether nodes had moved by no more than RESI_GEOM since points were faced before (see geometry_change).
  bool geometry_is_at_rest() const { return geometry_change_ <= definition_.joint_geometry_tolerance; }
  /// Whether points overlap at u that wait for the geometry at the end of the step (see hold_back_points): points must
  /// be faced anew.
  bool leaves_overlap(const Eigen::VectorXd& u) const;
  /// After a new factorisation.
  void forget();

  /// Forces on the reduced unknowns.
  Eigen::VectorXd forces() const;

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

  /// Raises the penalty of zones where points lie deeper at u than allowed (MixedZone::largest_depth), or points that
  /// stick slip by more (MixedZone::largest_slip); whether there were any. Throws Error `no-convergence` where that
  /// does not help.
  bool stiffen_penalties(const Eigen::VectorXd& u);

  /// Of a step that has converged at u: how far penalties, and faces too coarse for what they touch, let the bodies
  /// into each other. Costs a solve where there are penalties.
  void note_doubts(const Eigen::VectorXd& u, ContactDoubts& doubts);
  /// Of the last step: motions of bodies that nothing holds, not even the points that are closed.
  void note_loose_bodies(ContactDoubts& doubts) const;
  /// How far contact forces, all or those of the zone alone, move its points, at most, zone by zone (lengths); 0 of
  /// zones that have none.
  std::vector<double> pushed_back();

  /// CONT_ELEM at u (see contact_field.hpp); nothing without zones of local average contact.
  std::optional<ElementField> patch_state(const Eigen::VectorXd& u) const;

  /// Of the mixed formulation alone: adds LAGS_C (minus the pressure) to a field of displacements, zero where contact
  /// is open, absent but at slave nodes (under local average contact at those inside patches); with friction LAGS_F1,
  /// LAGS_F2 too: the shear that resists slip, as a share of the limit of friction.
  void add_multipliers(const Eigen::VectorXd& u, NodalField& displacements) const;
  /// CONT_NOEU (see contact_field.hpp) at u.
  NodalField contact_state(const Eigen::VectorXd& u, Positions positions, double instant) const;

 private:
  using Key = ContactRows::Key;

  void start_statuses(const Eigen::VectorXd& jumps);
  std::vector<ZoneMemory> zone_definitions() const;
  std::vector<char> held_points();
  void close_nearest(const Eigen::VectorXd& jumps);
  void apply_penalties(int zone, CondensedPoint& point) const;
  std::vector<char> shared_multipliers() const;
  void share_friction();
  void add_natural_augmentation();
  double augmentation_of(const ContactZone& zone) const;
  bool lower_augmentation();
  CondensedSolution solve_law();
  double stiffness_at(std::size_t p) const;
  double resistance_at(std::size_t p) const;
  Eigen::Vector3d multiplier(int number) const;
  bool is_faced_again() const;
  void hold_back_points();
  void check_blocked_points(const Eigen::VectorXd& jumps) const;
  std::vector<int> row_keys() const;
  void update_schur();
  Eigen::VectorXd shears() const;
  Eigen::VectorXd jumps_without(const Eigen::VectorXd& contact_forces, const Eigen::VectorXd& u);
  double displacement_of_surfaces(const Eigen::VectorXd& u) const;
  double motion_of(int zone, const Eigen::VectorXd& u) const;
  Eigen::VectorXd pushed_by(const Eigen::VectorXd& contact_forces);
  /// The forces without those of other zones.
  Eigen::VectorXd forces_of(int zone, Eigen::VectorXd forces) const;
  void note_depth(int zone, const Eigen::VectorXd& now, const Eigen::VectorXd& without, ContactDoubts& doubts) const;
  void note_creep(int zone, const Eigen::VectorXd& u, const Eigen::VectorXd& now, const Eigen::VectorXd& without,
                  ContactDoubts& doubts) const;
  void note_unshared_friction(ContactDoubts& doubts) const;
  void note_lowered_augmentation(ContactDoubts& doubts) const;
  /// Whether the overlap of the point says nothing of its penalty: next to no force belongs to it.
  bool is_free_of_force(std::size_t point) const {
    return points()[point].bears_nothing && problem_.points[point].law.penalised;
  }
  void show_pressures_on_axis(const std::function<double*(int)>& place) const;
  void add_idle_multipliers(const Eigen::VectorXd& u, const std::function<double*(int)>& place) const;
  double share_of_limit(const CondensedPoint& point, double slip, double limit) const;
  Eigen::VectorXd shear_rows(std::size_t p, const Eigen::VectorXd& jumps) const;
  Eigen::Vector3d shear_force(std::size_t p, const Eigen::VectorXd& jumps) const;
  void add_forces_between_nodes(const Eigen::VectorXd& jumps, std::map<Key, std::size_t>& by_node,
                                std::vector<NodeContact>& contacts) const;
  void add_nodes_without_contact(Positions positions, double instant, std::vector<NodeContact>& contacts) const;
  void note_held_overlaps(const Eigen::VectorXd& now, ContactDoubts& doubts) const;
  void note_coarse_faces(const Eigen::VectorXd& u, ContactDoubts& doubts);
  void note_friction_between_nodes(ContactDoubts& doubts) const;
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
  std::shared_ptr<const ContactMemory> resumed_;  ///< null once statuses have started from it
  ActiveSetMemory memory_;
  NearInverse near_inverse_;
  InterpolatedSolver interpolated_solver_;
  ShareSearch share_search_;
  CondensedProblem problem_;
  CondensedState state_;
  bool started_ = false;
  double augmentation_share_ =
      1.0;  ///< of what is given, between nodes: lowered in a step where nothing else leads to a solution
  bool rubs_by_shears_ = false;  ///< see CondensedSolution::by_shears
  std::tuple<CondensedState, RaisedPenalties, bool> remembered_;
  std::size_t spring_count_ = 0;
  Eigen::VectorXd forces_;  ///< on the rows
  Eigen::VectorXd reference_;
  Eigen::VectorXd faced_at_;  ///< u where `linearise` faced the points; at first the beginning of the step
  double geometry_change_ = 0.0;
  Eigen::VectorXd start_;               ///< multipliers when the step began
  Eigen::VectorXd rates_;               ///< of multipliers, in the last step that was accepted
  bool step_begins_ = false;            ///< and no point has been faced in it
  std::vector<std::size_t> held_back_;  ///< points that may not close yet
  std::unique_ptr<SchurComplement> schur_;
};

}  // namespace comma::solver
