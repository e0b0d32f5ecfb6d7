#include "solver/nonlinear/iterations/residual_watch.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

ResidualWatch residual_watch(const StepPlan& plan) {
  ResidualWatch watch;
  watch.stops_divergence = plan.event(StepEventKind::divergence) != nullptr;
  if (const StepEvent* event = plan.event(StepEventKind::residual)) watch.largest = event->limit;
  watch.further = plan.further_iterations;
  return watch;
}

void look_at_residuals(const ResidualWatch& watch, std::span<const IterationReport> history) {
  const IterationReport& last = history.back();
  if (watch.largest && last.absolute_residual > *watch.largest)
    throw Error("residual-too-large",
                fmt::format("t = {:.6g}: the residual of iteration {} is {:.3e} ({}), and RESI_GLOB_MAXI = {:.3g}",
                            last.instant, last.iteration, last.absolute_residual, last.worst, *watch.largest),
                "take smaller steps, or allow more");
  const std::size_t count = history.size();
  if (!watch.stops_divergence || count < 3) return;
  if (std::min(last.absolute_residual, history[count - 2].absolute_residual) <= history[count - 3].absolute_residual)
    return;
  throw Error("residual-diverges",
              fmt::format("t = {:.6g}: the residual grows, from {:.3e} to {:.3e} in iteration {} ({})", last.instant,
                          history[count - 3].absolute_residual, last.absolute_residual, last.iteration, last.worst),
              "take smaller steps");
}

std::optional<int> expected_iterations(std::span<const double> residuals, double limit) {
  constexpr std::size_t left_out = 3, counted_twice = 3;
  const std::size_t count = residuals.size();
  if (count < telling_iterations) return std::nullopt;
  double weights = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t k = left_out; k < count; ++k) {
    const double weight = k + counted_twice >= count ? 2.0 : 1.0;
    const double at = static_cast<double>(k), value = std::log(residuals[k]);
    weights += weight;
    x += weight * at;
    y += weight * value;
    xx += weight * at * at;
    xy += weight * at * value;
  }
  const double slope = (weights * xy - x * y) / (weights * xx - x * x);
  if (!(slope < 0.0)) return std::nullopt;
  const double reached = (std::log(limit) - (y - slope * x) / weights) / slope;
  constexpr double beyond_hope = 1e6;
  return reached < beyond_hope ? std::optional(static_cast<int>(std::lround(reached))) : std::nullopt;
}

}  // namespace comma::solver
