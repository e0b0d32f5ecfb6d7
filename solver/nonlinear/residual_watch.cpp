#include "solver/nonlinear/residual_watch.hpp"

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

std::optional<int> iterations_to_go(std::span<const IterationReport> history, double excess) {
  constexpr std::size_t looked_at = 3;
  if (history.size() < looked_at || !(excess > 1.0)) return std::nullopt;
  const double rate =
      std::log(history[history.size() - looked_at].absolute_residual / history.back().absolute_residual) /
      (looked_at - 1);
  if (!(rate > 0.0)) return std::nullopt;
  const double needed = std::ceil(std::log(excess) / rate);
  constexpr double beyond_hope = 1e6;
  return needed < beyond_hope ? std::optional(static_cast<int>(needed)) : std::nullopt;
}

}  // namespace comma::solver
