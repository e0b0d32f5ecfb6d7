#include "solver/nonlinear/convergence.hpp"

#include <algorithm>
#include <cmath>

namespace comma::solver {

ConvergenceCriterion::Measure ConvergenceCriterion::measure(double residual, double load, bool is_rounding, double referred) const {
  Measure result;
  result.absolute = residual;
  const bool has_history = smallest_load_ > 0.0;
  const bool vanished = !(load > (has_history ? vanishing_load * smallest_load_ : 0.0));
  result.relative = vanished ? -1.0 : residual / load;
  if (!std::isfinite(residual) || !std::isfinite(load)) return result;
  const double vanished_limit = has_history ? relative_limit() * smallest_load_ : default_absolute_residual;
  const bool passes_relative = is_rounding || (vanished ? residual <= vanished_limit : result.relative <= relative_limit());
  // One that is not given neither holds nor fails.
  std::vector<bool> passed;
  if (options_.absolute_residual) passed.push_back(residual <= *options_.absolute_residual);
  if (options_.referred_residual) passed.push_back(is_rounding || referred <= *options_.referred_residual);
  if (options_.relative_residual || passed.empty()) passed.push_back(passes_relative);
  const auto holds = [](bool each) { return each; };
  result.converged = options_.one_criterion ? std::ranges::any_of(passed, holds) : std::ranges::all_of(passed, holds);
  return result;
}

void ConvergenceCriterion::accept(double load) {
  if (load > 0.0) smallest_load_ = smallest_load_ > 0.0 ? std::min(smallest_load_, load) : load;
}

}  // namespace comma::solver
