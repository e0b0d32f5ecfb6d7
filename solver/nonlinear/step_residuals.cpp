// The part of NewtonSolver that tells how far a state is from balance, at free unknowns and at those that conditions
// hold.
#include <algorithm>
#include <cmath>

#include "solver/linear/largest_component.hpp"
#include "solver/nonlinear/newton.hpp"

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
  load_ = knows_reactions() && reactions_.size() ? load_with_reactions(loads, internal)
                                                 : weights_.load_size(loads, internal, variable_forces_);
  applied_ = largest_component(loads);
}

/// Whether what holds the bodies has the reactions of the linear solves while iterations go on, as multipliers have
/// them in Code_Aster: what the internal forces there differ by is a residual as well (17.3).
bool NewtonSolver::knows_reactions() const {
  return !has_conditions() && !relations_.update && !tangent_.is_constant();
}

/// After a correction of which a share was taken: `balance` as it was before, `change` the whole correction.
void NewtonSolver::take_reactions(const Eigen::VectorXd& balance, const Eigen::VectorXd& change, double taken) {
  Eigen::VectorXd solved = tangent_.held_forces(change) - balance;
  for (const int dof : elimination_.kept()) solved[dof] = 0.0;
  if (taken == 1.0 || reactions_.size() != solved.size())
    reactions_ = taken * solved;
  else
    reactions_ += taken * (solved - reactions_);
}

/// By what internal forces, less loads, differ from the reactions; one a degree of freedom.
Eigen::VectorXd NewtonSolver::held_imbalance() const {
  Eigen::VectorXd left = Eigen::VectorXd::Zero(balance_.size());
  if (!knows_reactions() || reactions_.size() != left.size()) return left;
  left = -balance_ - reactions_;
  for (const int dof : elimination_.kept()) left[dof] = 0.0;
  for (const int dof : eliminated_) left[dof] = 0.0;
  return left;
}

double NewtonSolver::load_with_reactions(const Eigen::VectorXd& loads, const Eigen::VectorXd& internal) const {
  Eigen::VectorXd borne = reactions_;
  for (const int dof : eliminated_) borne[dof] = internal[dof] - loads[dof];
  return weights_.load_size(loads, loads + borne, variable_forces_);
}

ConvergenceCriterion::Measure NewtonSolver::distance(const NewtonState& state) const {
  const Eigen::VectorXd weighed = weights_.weighed(residual_);
  const MixedContact::HeldImbalance held = mixed_ ? mixed_->held_imbalance(balance_) : MixedContact::HeldImbalance();
  const Eigen::VectorXd left = held_imbalance(), weighed_left = weights_.weighed_all(left);
  const double at_supports = std::max(held.counted, largest_component(weighed_left));
  auto by_component = reference_.share_by_component(weighed);
  if (by_component) by_component = std::max(*by_component, *reference_.share_by_component_of_all(weighed_left));
  return criterion_.measure(std::max(at_supports, largest_component(weighed)), std::max(held.largest, load_),
                            is_rounding(state) && largest_component(weighed_left) <= rounding_share * load_,
                            std::max(reference_.share(residual_), reference_.share_of_all(left)), by_component);
}

/// Whether the residual is no more than the last bits of u, moved to and fro, make of it. Not where u is so large that
/// the loads are lost in them: a body that nothing holds has flown away.
bool NewtonSolver::is_rounding(const NewtonState& state) const {
  if (applied_ > 0.0 && largest_component(residual_) > lost_load * applied_) return false;
  return tangent_.row_sizes().size() == residual_.size() && !tangent_.is_saddle() &&
         (residual_.array().abs() <= rounding_share * tangent_.sizes_times(state.u).array()).all();
}

}  // namespace comma::solver
