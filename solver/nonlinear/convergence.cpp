#include "solver/nonlinear/convergence.hpp"

#include <algorithm>
#include <cmath>

namespace comma::solver {

ConvergenceCriterion::Measure ConvergenceCriterion::measure(double residual, double load, bool is_rounding) const {
  Measure result;
  result.absolute = residual;
  const bool has_history = smallest_load_ > 0.0;
  const bool vanished = !(load > (has_history ? vanishing_load * smallest_load_ : 0.0));
  result.relative = vanished ? -1.0 : residual / load;
  if (!std::isfinite(residual) || !std::isfinite(load)) return result;
  const double vanished_limit = has_history ? relative_limit() * smallest_load_ : default_absolute_residual;
  const bool passes_relative = is_rounding || (vanished ? residual <= vanished_limit : result.relative <= relative_limit());
  if (!options_.absolute_residual) {
    result.converged = passes_relative;
    return result;
  }
  const bool passes_absolute = residual <= *options_.absolute_residual;
  if (!options_.relative_residual) result.converged = passes_absolute;
  else result.converged = options_.one_criterion ? passes_absolute || passes_relative : passes_absolute && passes_relative;
  return result;
}

void ConvergenceCriterion::accept(double load) {
  if (load > 0.0) smallest_load_ = smallest_load_ > 0.0 ? std::min(smallest_load_, load) : load;
}

}  // namespace comma::solver
