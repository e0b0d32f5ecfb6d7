// What the residuals of a step tell before its iterations end (U4.34.03: DIVE_RESI, RESI_MAXI, ITER_SUPPL).
#pragma once

#include <optional>
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

/// After how many iterations, the prediction not counted, residuals are to fall to a limit: where the line reaches it
/// that fits their logarithms best, the first three left out and the last three counted twice (17.3; 91 estimates that
/// it prints). Nothing with fewer than `telling_iterations`, or where they do not shrink.
std::optional<int> expected_iterations(std::span<const double> residuals, double limit);

}  // namespace comma::solver
