// The reduced tangent and its factorisation, kept as long as it is the same.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "solver/constraints/elimination.hpp"
#include "solver/elements/assembler.hpp"
#include "solver/elements/follower_forces.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/linear/unsymmetric_solver.hpp"
#include "solver/nonlinear/iterations/known_solutions.hpp"
#include "solver/nonlinear/static_analysis.hpp"
#include "solver/unilateral/rounds.hpp"

namespace comma::solver {

class TangentSystem;

/// Whether the stiffness is to be made again for an iteration (from 1) of the step after so many accepted ones.
bool is_tangent_due(const TangentPolicy& policy, const TangentSystem& tangent, int iteration, int steps);

/// T^T K T behind one linear solver: pattern analysed once, factorised once when the tangent is constant. Where an
/// element is unsymmetric, K has a skew part besides and another solver takes over, whichever method was asked for.
class TangentSystem {
 public:
  /// From this many unknowns on multigrid is faster than a factor, for a solid and few right-hand sides
  /// (docs/linear_solvers.md).
  static constexpr int large_solid = 10000;
  /// So many are few: a factor costs as much as a dozen solutions by multigrid at 50,000 unknowns, as thirty at
  /// 400,000.
  static constexpr std::size_t few_solutions = 5;

  /// Keeps references to its arguments.
  TangentSystem(const Model& model, const DofMap& dofs, const Assembler& assembler, const Elimination& elimination,
                const NewtonOptions& options, Counters& counters);

  /// Factorises the tangent at u unless it is known already, for the assembler's instant too. `kind`: which one, of
  /// bodies that are not linear. Returns whether it was factorised. Throws Error `singular-matrix` naming the nodes,
  /// components and rigid motion that nothing holds; `unsupported` for conjugate gradients with an unsymmetric tangent.
  bool refresh(const Eigen::VectorXd& u, TangentKind kind = TangentKind::tangent);
  /// Which one is factorised.
  TangentKind kind() const { return kind_; }
  /// The elimination is another from now on: nothing that was factorised is of use.
  void forget();
  /// Whether there is a factorisation, of whatever displacement.
  bool is_ready() const { return factorised_; }

  /// T^T K d of a displacement d of the unknowns that conditions eliminate: the forces on the reduced ones, by the
  /// tangent that was factorised last, or by the constant one.
  Eigen::VectorXd reduced_forces(const Eigen::VectorXd& u, const Eigen::VectorXd& d, TangentKind kind) const;
  /// K d of each column, on all degrees of freedom.
  Eigen::MatrixXd forces(const Eigen::VectorXd& u, const Eigen::MatrixXd& d, TangentKind kind) const;

  /// K d at the unknowns that conditions eliminate, by the tangent that was factorised last and is no constant one;
  /// zero at the others. All degrees of freedom in and out.
  Eigen::VectorXd held_forces(const Eigen::VectorXd& d) const { return held_rows_ * d; }

  /// From now on springs are added where nothing holds the bodies, instead of an error: whoever calls this takes them
  /// off again.
  void allow_springs() { may_add_springs_ = true; }
  /// From now on where hardly anything holds them, too: what a body on weak supports does without contact is so far off
  /// that little is left of the digits of what it does with it. False, and nothing changes, where the last factor has
  /// lost few digits, or springs are there already.
  bool spring_weak_supports();
  /// The forces take part in the tangent from now on; they must outlive the system.
  void follow(const FollowerForces& forces) { followers_ = &forces; }
  /// From now on a symmetric stiffness stands for the tangent, as contact needs one: iterations correct the rest.
  void stay_symmetric() { stays_symmetric_ = true; }
  /// No longer: the tangent is the derivative of the forces.
  void take_derivative() {
    stays_symmetric_ = false;
    forget();
  }
  /// Whether the tangent is the same for every displacement.
  bool is_constant() const { return assembler_.is_linear() && followers_ == nullptr; }

  /// The reduced unknowns that hold a spring to the ground, and its stiffness.
  const std::vector<std::pair<int, double>>& springs() const { return springs_; }

  /// In words, what nothing but whoever allowed springs holds of the bodies, elastic and before deformation; empty
  /// where there are none.
  std::string unheld() const;
  /// The same of what moves rigidly beside what holds these rows of the reduced unknowns; empty too where the tangent
  /// changes with the displacement.
  std::string unheld_beside(const RowMatrix& held) const;

  /// Overwrites the columns (reduced_size x k) by K^-1 times them.
  void solve(Eigen::Ref<Eigen::MatrixXd> columns);
  /// The same where iterations around it correct what is missing (LinearSolver::solve_once).
  void solve_once(Eigen::Ref<Eigen::MatrixXd> columns) { solve_once(columns, {}); }
  /// The same for a correction of the displacements u (all unknowns): what their rounding makes of the residual may be
  /// left of it, if that is little beside it.
  void solve_correction(Eigen::Ref<Eigen::MatrixXd> column, const Eigen::VectorXd& u);

  /// Whether `compliance` gives one.
  bool gives_compliance() const { return !unsymmetric_ && solver_ && elimination_.reduced_size() >= large_solid; }
  /// rows K^-1 rows^T (m x m) at once (LinearSolver::compliance); empty where column by column is as good.
  Eigen::MatrixXd compliance(const RowMatrix& rows);

  /// Whether a factor stands behind the solutions, so that another one costs little.
  bool has_factor() const { return unsymmetric_ || (solver_ && solver_->method() != LinearMethod::multigrid); }

  /// Whether the last factor has nearly all digits, so that a solution needs no correction around it.
  bool loses_few_digits() const { return lost_digits_ <= LinearSolver::few_digits; }
  /// What rounds of corrections of contact forces may leave, as a share of the largest (settle_in_rounds).
  double negligible_rest() const {
    return loses_few_digits() ? negligible_rest_of_stiff_bodies : solver::negligible_rest;
  }

  /// Whether the last factorised tangent of one kind of unknowns has a negative eigenvalue: compliances may be negative
  /// then.
  bool is_indefinite() const { return is_indefinite_; }

  /// Whether unknowns are of several kinds, so that one size does not suit all.
  bool is_saddle() const { return is_saddle_; }

  /// The largest |K_ij| of all unknowns at u, whatever is held.
  double largest_term(const Eigen::VectorXd& u) const;
  /// The sum of |K_ij| over each row of the last factorised tangent (reduced_size).
  const Eigen::VectorXd& row_sizes() const { return row_sizes_; }
  /// Of each unknown the largest of its kind (translations, rotations, others) in its body: what its rounding is a
  /// share of. Bodies are what elements and relations join. All unknowns in and out.
  Eigen::VectorXd magnitudes(const Eigen::VectorXd& u) const;
  /// |K| |u| with the largest of the translations (and what else is no rotation) of the body in place of each, and its
  /// largest rotation in place of each of these: bounds what a share of u, its rounding, does to the residual, whatever
  /// the unit of length. Bodies are what elements and relations join. All unknowns in, reduced_size out.
  Eigen::VectorXd sizes_times(const Eigen::VectorXd& u) const;

 private:
  void solve_once(Eigen::Ref<Eigen::MatrixXd> columns, const Eigen::VectorXd& rounding);
  /// The largest unknowns of a body.
  struct Largest {
    double translation = 0.0, rotation = 0.0, other = 0.0;
    double& of(Component component);
  };
  SymmetricMatrix stiffness(const Eigen::VectorXd& u, TangentKind kind) const;
  std::string parts_on_springs(const RowMatrix* held) const;
  SymmetricMatrix assembled(const Eigen::VectorXd& u, TangentKind kind) const;
  SymmetricMatrix assembled_anew(const Eigen::VectorXd& u, TangentKind kind, const SkewMatrix& skew_half);
  SymmetricMatrix reduce(SymmetricMatrix whole) const;
  void take_held_rows(const SymmetricMatrix& whole, const SkewMatrix& skew_half);
  bool is_known(TangentKind kind) const;
  bool is_symmetric() const { return stays_symmetric_ || (assembler_.is_symmetric() && !followers_); }
  SkewMatrix skew(const Eigen::VectorXd& u, TangentKind kind) const;
  void factorise(SymmetricMatrix reduced);
  void factorise(const SymmetricMatrix& reduced, const SkewMatrix& skew);
  bool add_springs(const FactorReport& report, SymmetricMatrix& reduced);
  bool is_held_elastically(const Eigen::VectorXd& u);
  LinearMethod chosen_method(const SymmetricMatrix& reduced);
  FactorReport factorise_with(LinearMethod method, const SymmetricMatrix& reduced);
  void measure_rows(const SymmetricMatrix& reduced);
  std::vector<int> bodies() const;
  std::size_t body_of(int dof) const {
    return static_cast<std::size_t>(body_of_node_[static_cast<std::size_t>(dofs_.node_of(dof))]);
  }
  std::vector<Largest> largest_of_bodies(const Eigen::VectorXd& u) const;

  const Model& model_;
  const DofMap& dofs_;
  const Assembler& assembler_;
  const Elimination& elimination_;
  const NewtonOptions& options_;
  Counters& counters_;
  bool is_saddle_;  ///< by the kind of elements
  const FollowerForces* followers_ = nullptr;
  bool stays_symmetric_ = false;
  LinearOptions linear_;
  std::unique_ptr<LinearSolver> solver_;
  KnownSolutions known_;  ///< of the symmetric factor
  std::unique_ptr<UnsymmetricSolver> unsymmetric_;
  Eigen::VectorXd row_sizes_, rotation_sizes_;
  mutable std::vector<int> body_of_node_;  ///< once asked for
  RowMatrix held_rows_;                    ///< of the stiffness, empty at unknowns that are not eliminated
  RowMatrix held_columns_;                 ///< its columns there
  int lost_digits_ = 0;
  bool is_indefinite_ = false;
  bool factorised_ = false;
  TangentKind kind_ = TangentKind::tangent;  ///< which was factorised
  bool multigrid_failed_ = false;
  bool may_add_springs_ = false;
  std::vector<std::pair<int, double>> springs_;
  int version_ = 0;  ///< of the assembler's stiffness, when last factorised
};

}  // namespace comma::solver
