// What the residuals of a step tell before its iterations end (U4.34.03: DIVE_RESI, RESI_MAXI, ITER_SUPPL).
#pragma once

#include <span>

#include "solver/nonlinear/static_analysis.hpp"

namespace comma::solver {

/// Which of these are wanted.
struct ResidualWatch {
  bool stops_divergence = false;  ///< a residual that grows twice ends the step
  std::optional<double> largest;  ///< N: a residual beyond it ends the step
  double further = 0.0;           ///< share of the most iterations that may follow them
};

ResidualWatch residual_watch(const StepPlan& plan);

/// Throws Error `residual-diverges` where neither of the last two residuals is below the one before them,
/// `residual-too-large` beyond the limit.
void look_at_residuals(const ResidualWatch& watch, std::span<const IterationReport> history);

/// How many iterations it takes at the mean rate of the last three residuals until the last one has shrunk `excess`
/// times; nothing where they do not shrink.
std::optional<int> iterations_to_go(std::span<const IterationReport> history, double excess);

}  // namespace comma::solver
