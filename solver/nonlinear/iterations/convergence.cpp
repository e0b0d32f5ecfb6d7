#include "solver/nonlinear/iterations/convergence.hpp"
#include "solver/linear/largest_component.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace comma::solver {
namespace {

/// The least limit is above 0: what is no larger than it passes.
double excess_over(double limit, double value) { return value / std::max(limit, std::numeric_limits<double>::min()); }

}  // namespace

double load_size(const Eigen::VectorXd& loads, const Eigen::VectorXd& internal,
                 const Eigen::VectorXd& variable_forces) {
  const Eigen::VectorXd borne = loads.cwiseAbs().cwiseMax((loads - internal).cwiseAbs());
  return largest_component(variable_forces.size() ? Eigen::VectorXd(borne + variable_forces.cwiseAbs()) : borne);
}

void RowWeights::take(const Assembler& assembler, const Elimination& elimination) {
  all_ = assembler.residual_weights();
  if (all_.size()) reduced_ = all_(elimination.kept());
}

Eigen::VectorXd RowWeights::weighed(const Eigen::VectorXd& reduced_residual) const {
  if (!all_.size()) return reduced_residual;
  return reduced_.cwiseProduct(reduced_residual);
}

Eigen::VectorXd RowWeights::weighed_all(const Eigen::VectorXd& residual) const {
  if (!all_.size()) return residual;
  return all_.cwiseProduct(residual);
}

double RowWeights::load_size(const Eigen::VectorXd& loads, const Eigen::VectorXd& internal,
                             const Eigen::VectorXd& variable_forces) const {
  if (!all_.size()) return solver::load_size(loads, internal, variable_forces);
  const Eigen::VectorXd pushed =
      variable_forces.size() ? Eigen::VectorXd(all_.cwiseProduct(variable_forces)) : variable_forces;
  return solver::load_size(all_.cwiseProduct(loads), all_.cwiseProduct(internal), pushed);
}

ConvergenceCriterion::Measure ConvergenceCriterion::measure(double residual, double load, bool is_rounding,
                                                            double referred, std::optional<double> by_component) const {
  Measure result;
  result.absolute = residual;
  const bool has_history = smallest_load_ > 0.0;
  const bool vanished = has_vanished(load);
  result.relative = vanished ? -1.0 : residual / load;
  if (!std::isfinite(residual) || !std::isfinite(load)) return result;
  const double rounding = rounding_of_loads * largest_load_;
  const double of_history = has_history      ? relative_limit() * smallest_load_
                            : rounding > 0.0 ? rounding
                                             : default_absolute_residual;
  const double vanished_limit = std::max(of_history, rounding);
  const double to_loads = is_rounding ? 0.0
                          : vanished  ? excess_over(vanished_limit, residual)
                                      : excess_over(relative_limit(), result.relative);
  // One that is not given neither holds nor fails.
  std::vector<double> excesses;
  if (options_.absolute_residual) excesses.push_back(excess_over(*options_.absolute_residual, residual));
  if (options_.referred_residual)
    excesses.push_back(is_rounding ? 0.0 : excess_over(*options_.referred_residual, referred));
  if (options_.component_residual) {
    const double share = by_component.value_or(vanished ? 0.0 : result.relative);
    excesses.push_back(is_rounding ? 0.0 : excess_over(*options_.component_residual, share));
  }
  if (options_.relative_residual || excesses.empty()) excesses.push_back(to_loads);
  result.excess = options_.one_criterion ? std::ranges::min(excesses) : std::ranges::max(excesses);
  result.converged = result.excess <= 1.0;
  return result;
}

bool ConvergenceCriterion::has_vanished(double load) const {
  return !(load >
           std::max(smallest_load_ > 0.0 ? vanishing_load * smallest_load_ : 0.0, rounding_of_loads * largest_load_));
}

void ConvergenceCriterion::accept(double load) {
  take_up(load);
  if (load > 0.0 && !has_vanished(load)) smallest_load_ = smallest_load_ > 0.0 ? std::min(smallest_load_, load) : load;
}

}  // namespace comma::solver
