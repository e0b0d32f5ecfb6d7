#include "solver/nonlinear/static_analysis.hpp"

#include "solver/nonlinear/steps/static_run.hpp"

namespace comma::solver {

void require_solvable(const StaticProblem& problem, const StepPlan& plan, const NewtonOptions& options) {
  Result result;
  Counters counters;
  StaticRun(problem, options, result, counters, {}, {}).begin(plan);
}

ContactDoubts solve_static(const StaticProblem& problem, const StepPlan& plan, const NewtonOptions& options,
                           Result& result, Counters& counters, const IterationObserver& observer,
                           const StepObserver& after_step) {
  NewtonOptions chosen = options;
  const bool solves_once = !problem.contact && problem.unilateral.empty() && !options.path && !options.stability;
  chosen.few_solutions = solves_once && plan.instants.size() <= TangentSystem::few_solutions + 1;
  StaticRun run(problem, chosen, result, counters, observer, after_step);
  run.run(plan);
  return run.doubts();
}

}  // namespace comma::solver
