#include "solver/nonlinear/static_analysis.hpp"

#include "solver/nonlinear/static_run.hpp"

namespace comma::solver {

void require_solvable(const StaticProblem& problem, const StepPlan& plan, const NewtonOptions& options) {
  Result result;
  Counters counters;
  StaticRun(problem, options, result, counters, {}, {}).begin(plan);
}

ContactDoubts solve_static(const StaticProblem& problem, const StepPlan& plan, const NewtonOptions& options,
                           Result& result, Counters& counters, const IterationObserver& observer, const StepObserver& after_step) {
  StaticRun run(problem, options, result, counters, observer, after_step);
  run.run(plan);
  return run.doubts();
}

}  // namespace comma::solver
