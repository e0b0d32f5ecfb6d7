#include "solver/nonlinear/iterations/held_reactions.hpp"

#include <algorithm>

#include "solver/linear/largest_component.hpp"

namespace comma::solver {

using Eigen::VectorXd;

VectorXd HeldReactions::of(const VectorXd& balance, const VectorXd& change) const {
  VectorXd solved = tangent_.held_forces(change) - balance;
  for (const int dof : elimination_.kept()) solved[dof] = 0.0;
  return solved;
}

void HeldReactions::take(VectorXd solved, double taken) {
  if (taken == 1.0 || reactions_.size() != solved.size())
    reactions_ = taken * std::move(solved);
  else
    reactions_ += taken * (solved - reactions_);
}

VectorXd HeldReactions::imbalance(const VectorXd& balance) const {
  if (reactions_.size() != balance.size()) return VectorXd::Zero(balance.size());
  VectorXd left = -balance - reactions_;
  for (const int dof : elimination_.kept()) left[dof] = 0.0;
  for (const int dof : eliminated_) left[dof] = 0.0;
  return left;
}

double HeldReactions::load_size(const RowWeights& weights, const VectorXd& loads, const VectorXd& internal,
                                const VectorXd& variable_forces) const {
  VectorXd borne = reactions_;
  for (const int dof : eliminated_) borne[dof] = internal[dof] - loads[dof];
  return weights.load_size(loads, loads + borne, variable_forces);
}

ConvergenceCriterion::Measure measure(const ConvergenceCriterion& criterion, const ReferenceForces& reference,
                                      const RowWeights& weights, const Imbalance& imbalance, double load,
                                      double at_supports, bool is_rounding) {
  const VectorXd weighed = weights.weighed(imbalance.residual), weighed_left = weights.weighed_all(imbalance.left);
  auto by_component = reference.share_by_component(weighed);
  if (by_component) by_component = std::max(*by_component, *reference.share_by_component_of_all(weighed_left));
  return criterion.measure(
      largest_of({at_supports, largest_component(weighed_left), largest_component(weighed)}), load, is_rounding,
      largest_of({reference.share(imbalance.residual), reference.share_of_all(imbalance.left)}), by_component);
}

}  // namespace comma::solver
