// The part of NewtonSolver that tells how far a state is from balance, at free unknowns and at those that conditions
// hold.
#include <algorithm>
#include <cmath>

#include "solver/linear/largest_component.hpp"
#include "solver/nonlinear/iterations/newton.hpp"

namespace comma::solver {
namespace {

/// Residual that rounding leaves, as a share of |K| |u|: some tens of roundings, over elements and refinement.
constexpr double rounding_share = 1e-14;
/// A residual beyond this share of the applied loads has not taken them up.
constexpr double lost_load = 1e-3;

}  // namespace

/// With those that follow.
Eigen::VectorXd NewtonSolver::loads_at(const Eigen::VectorXd& u, const Eigen::VectorXd& external) const {
  return followers_ ? Eigen::VectorXd(external + followers_->at(u)) : external;
}

void NewtonSolver::evaluate(const NewtonState& state, const Eigen::VectorXd& external) {
  const Eigen::VectorXd internal = assembler_.internal_forces(state.u);
  if (tangent_.is_constant()) known_forces_.note(state.u, internal);
  measure(loads_at(state.u, external), internal);
}

/// Residual of the reduced unknowns and the size of the loads, reactions, contact forces and those of command variables
/// included.
void NewtonSolver::measure(const Eigen::VectorXd& loads, const Eigen::VectorXd& internal) {
  balance_ = loads - internal;
  residual_ = elimination_.transformation().transpose() * balance_;
  if (row_multipliers_.size()) residual_ -= reduced_.inequalities.rows.transpose() * row_multipliers_;
  if (mixed_) residual_ += mixed_->forces();
  load_ = knows_reactions() && held_.are_known() ? held_.load_size(weights_, loads, internal, variable_forces_)
                                                 : weights_.load_size(loads, internal, variable_forces_);
  applied_ = largest_component(loads);
}

/// Whether what holds the bodies has the reactions of the linear solves while iterations go on, as multipliers have
/// them in Code_Aster: what the internal forces there differ by is a residual as well (17.3).
bool NewtonSolver::knows_reactions() const {
  return !has_conditions() && !relations_.update && !tangent_.is_constant();
}

/// By what internal forces, less loads, differ from the reactions; one a degree of freedom.
Eigen::VectorXd NewtonSolver::held_imbalance() const {
  return knows_reactions() ? held_.imbalance(balance_) : Eigen::VectorXd(Eigen::VectorXd::Zero(balance_.size()));
}

ConvergenceCriterion::Measure NewtonSolver::distance(const NewtonState& state) const {
  const MixedContact::HeldImbalance held = mixed_ ? mixed_->held_imbalance(balance_) : MixedContact::HeldImbalance();
  const Eigen::VectorXd left = held_imbalance();
  const bool rounds = is_rounding(state) && largest_component(weights_.weighed_all(left)) <= rounding_share * load_;
  return comma::solver::measure(criterion_, reference_, weights_, {residual_, left}, largest_of({held.largest, load_}),
                                held.counted, rounds);
}

/// Whether the residual is no more than the last bits of u, moved to and fro, make of it. Not where u is so large that
/// the loads are lost in them: a body that nothing holds has flown away.
bool NewtonSolver::is_rounding(const NewtonState& state) const {
  if (applied_ > 0.0 && largest_component(residual_) > lost_load * applied_) return false;
  return tangent_.row_sizes().size() == residual_.size() && !tangent_.is_saddle() &&
         (residual_.array().abs() <= rounding_share * tangent_.sizes_times(state.u).array()).all();
}

}  // namespace comma::solver
