// A nonlinear static computation while it runs.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "solver/constraints/turning_links.hpp"
#include "solver/model/deformed_places.hpp"
#include "solver/nonlinear/contact/geometry_updates.hpp"
#include "solver/nonlinear/contact/surface_doubts.hpp"
#include "solver/nonlinear/iterations/newton.hpp"
#include "solver/nonlinear/iterations/path_following.hpp"
#include "solver/nonlinear/static_analysis.hpp"
#include "solver/nonlinear/steps/step_watch.hpp"

namespace comma::solver {

/// Behind solve_static() and require_solvable().
class StaticRun {
 public:
  StaticRun(const StaticProblem& problem, const NewtonOptions& options, Result& result, Counters& counters,
            const IterationObserver& observer, const StepObserver& after_step);
  void run(const StepPlan& plan);
  /// All that comes before the first step.
  void begin(const StepPlan& plan);
  const ContactDoubts& doubts() const { return doubts_; }

 private:
  /// What a step changes before it is accepted.
  struct Progress {
    NewtonState state;
    bool paired = false;
    std::vector<ContactPair> pairs;
    Eigen::VectorXd reference;  ///< u at the last pairing
    ConditionSet conditions;
  };

  // From step to step (static_run.cpp).
  void limit_depth(const StepEvent* event);
  /// The next step is measured against the internal forces of the moment.
  void begin_measuring();
  /// After a converged step, where they are asked for: whether they tell of an instability.
  bool find_modes(double instant, int accepted);
  void note_doubts_about_surfaces(double instant);
  std::vector<ContactPair> pairs_solved_with(double instant) const;
  bool is_mixed() const { return problem_.contact && is_condensed(*problem_.contact); }
  /// The loads, and the relations that contact faces bring along.
  std::vector<AppliedLoad> with_contact_relations() const;
  /// With the relations of rigid bodies at the displacements u.
  std::vector<AppliedLoad> all_conditions(const Eigen::VectorXd& u) const;
  void let_links_turn();
  /// The relations of rigid bodies at the state, which then satisfies them as they are linear there; returns the
  /// offset.
  Eigen::VectorXd turn_links(double time, NewtonState& state);
  std::vector<int> nodes_of_contact() const;
  /// The reduced unknowns behind the nodes that conditions speak of.
  std::vector<int> support() const;

  // A step in the ways that there are (step_attempts.cpp).
  /// The number of iterations; nothing when the step has failed, or does what it must not, and is cut. Throws what a
  /// step that cannot be cut throws.
  std::optional<int> try_step(double instant, StepSequence& sequence);
  std::nullopt_t take_again(double instant, const Progress& before, const StepSequence& sequence);
  void tell_failure(double instant, const Error& error, std::string_view then) const;
  void take_back(const Progress& before);
  /// Which points of contact are closed, one after the other.
  std::vector<char> closed_points() const;
  /// A step in which points close or open is taken again, shorter, as long as it may be: then it stands.
  bool refines_collision(const std::vector<char>& before, StepSequence& sequence) const;
  /// Those of Code_Aster: figures are then those of the same iterations (ssnv104d, to 2e-12).
  MixedContact::Iterations contact_iterations() const {
    return options_.line_search ? MixedContact::Iterations::settled
                                : mixed_->iterations_like_code_aster(problem_.contact->joint_iterations);
  }
  /// Where joint iterations fail, contact is settled within each: at once where the path does not matter, else in parts
  /// of a step that has been cut (ssnv506e), or where it cannot be.
  int solve_jointly_or_settled(double instant, const Progress& before, bool is_part);
  int solve_settled(double instant, const Progress& before);
  /// Of a step that cannot be cut.
  int solve_as_last_resort(double instant, const Progress& before, const Error& error);
  /// A prediction by the tangent leads astray where what flowed is unloaded: such a step is tried again from the
  /// elastic side.
  int solve_from_either_side(double instant, const Progress& before);
  /// With the derivative of the forces of beams in large rotations in place of Code_Aster's tangent.
  int solve_by_derivative(double instant, const Progress& before, const Error& failure);
  /// Supports so weak that they cost the digits of what contact does stand aside while it is sought.
  int solve_on_stiffer_supports(double instant, const Progress& before, const Error& failure);
  /// With the solution of the path that was passed over, where the plan says so; nothing where that fails too.
  std::optional<int> solve_the_other_way(double instant, const Progress& before, const Error& failure);
  int solve_and_check(double instant);
  int solve_telling_when(double instant);

  // The solution of one step (step_solution.cpp).
  int solve_step(double time);
  /// By fixed points on contact (see MixedContact::Iterations::rubbing), so many at least, each of which finds balance.
  int balance_by_fixed_points(double time, int least, const std::function<int()>& balance);
  /// Of contact, where they need not settle; whether any changed.
  bool adapt_penalties_once();
  /// Whether those of contact are others now, which have been adapted so often, and balance is to be found again.
  bool penalties_change(double time, int adaptations);
  /// A linear step: what has flowed goes on as it did. What the law makes of it counts from its end on.
  int solve_extrapolated(double time, const Eigen::VectorXd& external, const Eigen::VectorXd& offset);
  /// What the intensity multiplies, and what it does not.
  DrivenLoads driven_loads(double time);
  /// Puts the unknowns where the step is guessed to end, if anything but where it begins.
  void guess(double time);
  /// The surfaces as the displacements `u` have them: at first those with which the step begins, whatever is guessed of
  /// its end.
  void pair(double time, const Eigen::VectorXd& u, GeometryUpdates* updates);
  void resize_multipliers(const ConditionSet& next);
  /// ITER_CONT_MULT changes a condition; unilateral conditions alone need no user's word on it.
  int active_set_limit() const;
  /// Whether surfaces are faced anew at least as a step begins.
  bool pairs_each_step() const;
  /// Whether surfaces that face each other for good have gaps that change nevertheless.
  bool thickness_changes() const;

  // States it begins with and states it reaches (run_states.cpp).
  /// From the initial state, unstressed and undisplaced, or where the result's last step left off.
  void start(double instant);
  /// What the conditions of differential loads count from.
  Eigen::VectorXd differential_reference() const;
  void take_last_step();
  /// A path that goes on has an intensity and a direction.
  void go_on_with_path();
  void resume();
  std::shared_ptr<const ContactMemory> contact_so_far() const;
  /// The one variable of elasticity is zero, and says nothing to a law with a memory.
  static const ElementField* of_memory(const ElementField* variables);
  /// Without an initial state the body starts without stress, even where its first temperature is not that of
  /// reference.
  ElementField initial_stresses() const;
  void note_unused_stresses(const ElementField& given) const;
  void keep_given(const InitialState& given, ResultStep& step) const;
  /// Null where the step has it not.
  const ElementField* field_of_last_step(std::string_view name) const;
  std::span<const AppliedLoad> loads_so_far() const;
  /// Pairs the surfaces as they stand before anything presses.
  void pair_initially(double instant);
  std::vector<Eigen::Vector3d> positions() const { return positions_at(now_.state.u, mesh_, dofs_); }
  /// The multipliers of the mixed formulation are unknowns beside them.
  NodalField displacements() const;
  void add_internal_variables(ResultStep& step) const;
  std::optional<NodalField> contact_state(double instant) const;
  void add_patch_state(ResultStep& step) const;
  /// Displacements, stresses and internal variables.
  ResultStep fields_now(double instant) const;
  void archive(double instant, int iterations);
  /// What looks on may take fields away.
  void append(ResultStep step);

  const StaticProblem& problem_;
  const StepObserver& after_step_;
  const Mesh& mesh_;
  const NewtonOptions& options_;
  Result& result_;
  Counters& counters_;
  double drive_ = 1.0;  ///< what multiplies driven conditions on displacements while offsets are taken
  DofMap dofs_;
  Assembler assembler_;
  FollowerForces followers_;
  TurningLinks links_;
  Elimination elimination_;
  Eigen::VectorXd differential_from_;  ///< what differential conditions count from
  TangentSystem tangent_;
  ReferenceForces reference_;
  std::vector<int> contact_nodes_;
  const IterationObserver& observer_;
  NewtonSolver newton_;
  std::unique_ptr<MixedContact> mixed_;
  std::unique_ptr<PathFollowing> path_;
  Progress now_;
  std::optional<SurfaceDoubts> surface_doubts_;
  ContactDoubts doubts_;
  Eigen::VectorXd began_at_;  ///< u where the computation begins
  Eigen::VectorXd start_;     ///< u at the beginning of the step
  Eigen::VectorXd speed_;     ///< change of u over time in the last step; empty before the first
  int accepted_ = 0;          ///< steps
  double last_instant_ = 0.0;
  double last_duration_ = 0.0;         ///< of the last accepted step; 0 before
  bool may_cut_ = false;               ///< whether the step at hand may be cut where it fails
  bool takes_plain_tangents_ = false;  ///< beams in large rotations have those of Code_Aster 17.3, unless a step fails
  const StepPlan* plan_ = nullptr;
  std::optional<StepWatch> watch_;
};

}  // namespace comma::solver
