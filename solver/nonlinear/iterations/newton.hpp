// Newton's iterations of one step, with the inequalities solved inside each of them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/elements/assembler.hpp"
#include "solver/nonlinear/contact/mixed_contact.hpp"
#include "solver/nonlinear/iterations/condition_set.hpp"
#include "solver/nonlinear/iterations/convergence.hpp"
#include "solver/nonlinear/iterations/held_reactions.hpp"
#include "solver/nonlinear/iterations/known_forces.hpp"
#include "solver/nonlinear/iterations/reference_forces.hpp"
#include "solver/nonlinear/iterations/residual_watch.hpp"
#include "solver/nonlinear/iterations/tangent_system.hpp"
#include "solver/nonlinear/static_analysis.hpp"
#include "solver/unilateral/active_set.hpp"
#include "solver/unilateral/multiplier_course.hpp"
#include "solver/unilateral/schur_complement.hpp"

namespace comma::solver {

/// What the iterations change. `multipliers`: one a slot of the ConditionSet.
struct NewtonState {
  Eigen::VectorXd reduced;  ///< q
  Eigen::VectorXd u;        ///< T q + g
  Eigen::VectorXd multipliers;
};

/// The unknowns of a step are q in u = T q + g(t). An iteration solves
///
///     K dq = T^T (f_ext - f_int(u)) - A^T lambda,   A (q + dq) <= b with multipliers lambda >= 0
///
/// by the active-set method on the Schur complement, warm-started by the last active set. Internal forces come in
/// extended precision, so that with a constant tangent each further correction is a step of iterative refinement: two
/// or three of them take a solution near the last bit even where weak springs hold a stiff body.
class NewtonSolver {
 public:
  /// Keeps references to its arguments. `support`: the reduced unknowns that conditions can touch, rising.
  NewtonSolver(const Mesh& mesh, const DofMap& dofs, const Assembler& assembler, const Elimination& elimination,
               const NewtonOptions& options, Counters& counters, TangentSystem& tangent,
               const ReferenceForces& reference, std::vector<int> support, const IterationObserver& observer);

  /// Iterates to convergence at a time. `earlier`: iterations of the same step before, which count among those allowed,
  /// though one is always. `active_set_limit`: changes of the active set allowed in one iteration. Returns the number
  /// of iterations. Throws Error `no-convergence`, `contact-cycling`, `contradictory-conditions`, `singular-matrix`,
  /// and what look_at_residuals throws.
  int solve(double time, const Eigen::VectorXd& external, Eigen::VectorXd offset, const ConditionSet& conditions,
            int earlier, int active_set_limit, NewtonState& state);

  /// How inequalities are solved from now on; the definition must outlive the solver.
  void use_algorithm(const ContactDefinition& definition) { definition_ = &definition; }
  /// From now on each iteration makes the tangent again, whatever TangentPolicy says, and ELASTIQUE is that of where
  /// the bodies are, with elastic moduli: what contact adds to the stiffness makes Code_Aster 17.3 do so.
  void take_stiffness_of_contact() { contact_stiffens_ = true; }
  /// This step begins at displacements that are guessed: what the material does there counts, not where it was.
  void begin_moved() { is_moved_ = true; }

  /// Contact in the mixed formulation takes part in every solve from now on; null: none.
  void attach(MixedContact* mixed) { mixed_ = mixed; }

  /// These unknowns are eliminated, without reactions (AFFE_CHAR_CINE): what the linear solves do not balance there is
  /// no residual.
  void set_eliminated(std::vector<int> dofs) { held_.set_eliminated(std::move(dofs)); }

  /// The next solutions belong to a step of this length (s), which may be short enough for the elastic stiffness.
  void start_step(double duration);

  /// What residuals may do from now on.
  void watch(const ResidualWatch& residuals) { watch_ = residuals; }

  /// How far contact forces, all or those of the zone alone, move the nodes of its conditions, at most, zone by zone
  /// (lengths); 0 of zones where nothing is closed.
  std::vector<double> pushed_back(std::size_t zones);
  /// Of a step that has converged at the state: how far bounds that give way are passed, and what projected gradients
  /// leave.
  void note_doubts(const NewtonState& state, ContactDoubts& doubts);

  /// Which stiffness the first iteration of the next steps takes.
  void predict_with(TangentKind kind) { prediction_ = kind; }
  /// What takes relations between displacements anew at the unknowns, which it brings to satisfy them and renumbers,
  /// and returns the offset g; and how far they are from what the relations stand for, as a share. Empty: they stay.
  struct Relinearisation {
    std::function<Eigen::VectorXd(double time, NewtonState& state)> update;
    std::function<double(const Eigen::VectorXd& u)> violation;
  };
  void relinearise(Relinearisation relations) { relations_ = std::move(relations); }
  /// The forces act beside the external ones from now on; they must outlive the solver.
  void follow(const FollowerForces& forces) { followers_ = &forces; }

  /// The body bears these forces where the computation begins: they count in the criterion as those of an accepted
  /// step.
  void begin_with(const Eigen::VectorXd& external, const Eigen::VectorXd& internal) {
    weights_.take(assembler_, elimination_);
    criterion_.accept(weights_.load_size(external, internal, {}));
  }
  /// The step is accepted: its loads count in the criterion of later ones.
  void accept_step() {
    criterion_.accept(load_);
    ++steps_;
  }

 private:
  struct Correction {
    double step = 0.0;  ///< largest change of q over the largest q
    int changes = 0;    ///< rows whose status changed
  };

  /// `iteration`: of the step, from 1; geometries of contact that go on from one another count on.
  TangentKind kind_of(int iteration) const;
  void start(const Eigen::VectorXd& external, const Eigen::VectorXd& offset, int iteration, NewtonState& state);
  void take_conditions(double time, const ConditionSet& conditions, const Eigen::VectorXd& offset,
                       const NewtonState& state);
  void forget_stiffness();
  Correction correct(NewtonState& state, const Eigen::VectorXd& offset);
  void require_at_hand(double time, const Eigen::VectorXd& u) const;
  int further_iterations(double time, const std::vector<IterationReport>& history, double excess) const;
  bool is_satisfied(const Eigen::VectorXd& u) const;
  bool searches(int iteration) const;
  bool has_conditions() const { return mixed_ || row_multipliers_.size() > 0; }
  double search(const Eigen::VectorXd& before, const Eigen::VectorXd& external, const Eigen::VectorXd& offset,
                NewtonState& state);
  Correction correct_with_conditions(NewtonState& state);
  std::optional<double> settle_conditions(NewtonState& state);
  void throw_unless_solved(const ActiveSetSolution& solution) const;
  bool by_gradients() const { return definition_ && definition_->algorithm == ContactAlgorithm::projected_gradient; }
  bool by_compliance() const;
  /// Whether contact may stay open where it is violated (ActiveSetProblem::beginning). LIAISON_UNIL never does.
  bool passes_over() const { return definition_ && !by_gradients(); }
  Eigen::VectorXd violations_at(const Eigen::VectorXd& u) const;
  void note_passed_over(const NewtonState& state, ContactDoubts& doubts);
  void note_passed_bounds(const NewtonState& state, ContactDoubts& doubts);
  Eigen::VectorXd push_of_active();
  int zone_of(int row) const;
  Eigen::VectorXd compliance_times(const Eigen::VectorXd& multipliers);
  ActiveSetSolution solve_conditions(const ActiveSetProblem& problem);
  ActiveSetSolution solve_by_gradients(const ActiveSetProblem& problem);
  void evaluate(const NewtonState& state, const Eigen::VectorXd& external);
  Eigen::VectorXd loads_at(const Eigen::VectorXd& u, const Eigen::VectorXd& external) const;
  void measure(const Eigen::VectorXd& loads, const Eigen::VectorXd& internal);
  ConvergenceCriterion::Measure distance(const NewtonState& state) const;
  bool is_rounding(const NewtonState& state) const;
  bool knows_reactions() const;
  Eigen::VectorXd held_imbalance() const;
  void polish(NewtonState& state, const Eigen::VectorXd& external, const Eigen::VectorXd& offset);
  std::optional<double> penetration(const NewtonState& state) const;
  IterationReport report(double time, int iteration, const ConvergenceCriterion::Measure& measure, int changes,
                         const NewtonState& state) const;
  [[noreturn]] void fail(double time, const std::vector<IterationReport>& history) const;

  const Mesh& mesh_;
  const DofMap& dofs_;
  const Assembler& assembler_;
  const Elimination& elimination_;
  const NewtonOptions& options_;
  Counters& counters_;
  TangentSystem& tangent_;
  const std::vector<int> support_;
  const IterationObserver& observer_;
  ConvergenceCriterion criterion_;
  const ReferenceForces& reference_;

  Relinearisation relations_;
  const ContactDefinition* definition_ = nullptr;
  MixedContact* mixed_ = nullptr;
  const FollowerForces* followers_ = nullptr;
  const ConditionSet* conditions_ = nullptr;
  int active_set_limit_ = 0;
  ReducedInequalities reduced_;
  std::unique_ptr<SchurComplement> schur_;
  ActiveSetMemory memory_;
  MultiplierCourse course_;          ///< of steps that have converged
  Eigen::VectorXd row_multipliers_;  ///< one a reduced row
  std::vector<int> active_;          ///< reduced rows
  Eigen::VectorXd residual_;         ///< reduced
  Eigen::VectorXd variable_forces_;  ///< with which the strains of the command variables push (all unknowns); empty
                                     ///< where there are none
  KnownForces known_forces_;
  RowWeights weights_;
  double load_ = 0.0;
  Eigen::VectorXd beginning_;  ///< violations of the rows where the iteration begins
  Eigen::VectorXd balance_;    ///< external less internal forces, on all degrees of freedom
  double applied_ = 0.0;       ///< the largest component of the external forces
  HeldReactions held_;
  int steps_ = 0;  ///< accepted so far
  TangentKind prediction_;
  TangentPolicy policy_;  ///< of this step
  double duration_ = 0.0;
  bool contact_stiffens_ = false;
  bool is_moved_ = false;
  bool is_short_ = false;  ///< this step takes the elastic stiffness because of its length
  int most_iterations_;    ///< of this step
  ResidualWatch watch_;
};

}  // namespace comma::solver
