#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands/archiving.hpp"
#include "commands/commands.hpp"
#include "commands/observation.hpp"
#include "commands/problem_building.hpp"
#include "commands/selection.hpp"
#include "commands/solve_alarms.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

// Green-Lagrange strains where COMPORTEMENT asks for them.
std::shared_ptr<const solver::KinematicsOfCells> kinematics(const Call& call, const solver::Mesh& mesh) {
  auto result = std::make_shared<solver::KinematicsOfCells>();
  for (const Keywords& behaviour : call.factors("COMPORTEMENT")) {
    if (behaviour.text("DEFORMATION") != "GREEN_LAGRANGE") continue;
    result->resize(static_cast<std::size_t>(mesh.cell_count()), solver::Kinematics::small);
    if (!behaviour.has("GROUP_MA") && !behaviour.has("MAILLE")) std::ranges::fill(*result, solver::Kinematics::green_lagrange);
    for (const int cell : selected_cells(behaviour, mesh)) (*result)[static_cast<std::size_t>(cell)] = solver::Kinematics::green_lagrange;
  }
  if (result->empty()) return nullptr;
  return result;
}

solver::StaticProblem problem_of(const Call& call) {
  solver::StaticProblem problem = static_problem(call);
  problem.kinematics = kinematics(call, *problem.model->mesh);
  if (!call.has("CONTACT")) return problem;
  const auto& conditions = call.data<ContactConcept>("CONTACT").conditions;
  if (const auto* contact = std::get_if<solver::ContactDefinition>(&conditions)) {
    problem.contact = *contact;
  } else {
    problem.unilateral = std::get<std::vector<solver::UnilateralCondition>>(conditions);
  }
  return problem;
}

solver::StepPlan whole_plan(const Keywords& increment) {
  const auto& list = increment.concept_of("LIST_INST");
  if (const auto* plan = dynamic_cast<const StepPlanConcept*>(list->data.get())) return plan->plan;
  return solver::StepPlan(increment.data<ListConcept>("LIST_INST").values);
}

// The plan with those instants that INCREMENT keeps of its list; the first is the initial state.
solver::StepPlan steps_of(const Keywords& increment) {
  solver::StepPlan plan = whole_plan(increment);
  const std::vector<double> all = plan.instants;
  const auto index_of = [&](const char* number, const char* instant, std::size_t otherwise) {
    if (increment.given(number)) {
      const auto index = increment.integer(number);
      if (index >= 0 && index < static_cast<std::int64_t>(all.size())) return static_cast<std::size_t>(index);
      throw DiagnosticError("unknown-step", fmt::format("LIST_INST has the numbers 0 to {}", all.size() - 1), increment.span_of(number));
    }
    if (!increment.given(instant)) return otherwise;
    const double wanted = increment.real(instant);
    const double reach = increment.real("PRECISION") * (wanted == 0.0 ? 1.0 : std::abs(wanted));
    const auto found = std::find_if(all.begin(), all.end(), [&](double each) { return std::abs(each - wanted) <= reach; });
    if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
    throw DiagnosticError("unknown-step", fmt::format("LIST_INST has no instant {}", wanted), increment.span_of(instant),
                          fmt::format("it goes from {} to {}", all.front(), all.back()));
  };
  const std::size_t first = index_of("NUME_INST_INIT", "INST_INIT", 0);
  const std::size_t last = index_of("NUME_INST_FIN", "INST_FIN", all.size() - 1);
  if (last <= first) {
    throw DiagnosticError("wrong-order", "STAT_NON_LINE: INCREMENT leaves no step to compute", increment.span,
                          "the last instant must lie beyond the first");
  }
  plan.instants.assign(all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  return plan;
}

solver::NewtonOptions newton_options(const Call& call) {
  solver::NewtonOptions options;
  if (call.has("CONVERGENCE")) {
    const Keywords& convergence = call.factor("CONVERGENCE");
    const bool relative = convergence.given("RESI_GLOB_RELA");
    const bool absolute = convergence.given("RESI_GLOB_MAXI");
    if (relative) options.relative_residual = convergence.real("RESI_GLOB_RELA");
    if (absolute) options.absolute_residual = convergence.real("RESI_GLOB_MAXI");
    if (absolute && !relative) options.relative_residual.reset();
    options.one_criterion = convergence.text("VERIF") == "AU_MOINS_UN";
    if (convergence.has("ITER_GLOB_MAXI")) options.max_iterations = static_cast<int>(convergence.integer("ITER_GLOB_MAXI"));
  }
  const SolverChoice choice = solver_choice(call);
  options.method = choice.method;
  options.linear = choice.options;
  return options;
}

void show_header(const Call& call, const Context& context) {
  context.console.progress("STAT_NON_LINE " + call.result->name);
  context.console.progress("     instant  iter   relative   absolute  worst                 active  changes");
}

solver::IterationObserver live_table(const Context& context) {
  if (context.console.verbosity() == Verbosity::quiet) return {};
  return [&context](const solver::IterationReport& report) {
    if (!report.event.empty()) {
      context.console.progress("  " + report.event);
      return;
    }
    context.console.progress(fmt::format("  {:>10.5g} {:>5} {:>10.2e} {:>10.2e}  {:<20} {:>7} {:>8}", report.instant, report.iteration,
                                         report.relative_residual, report.absolute_residual, report.worst,
                                         report.active_conditions, report.contact_changes));
  };
}

}  // namespace

Product stat_non_line(const Call& call, Context& context) {
  auto product = std::make_shared<ResultConcept>();
  product->problem = problem_of(call);
  product->result.model = product->problem.model;
  const auto steps = steps_of(call.factor("INCREMENT"));
  show_header(call, context);
  // What has converged stays readable although the computation goes on to fail.
  call.result->data = product;
  warn_of_locking(call, product->problem, context);
  const solver::Counters before = context.counters;
  const Observer observer(call, product->result.mesh());
  if (!observer.empty()) product->observations.emplace();
  Archive archive(call);
  const auto after_step = [&, number = 0](solver::Result& result) mutable {
    if (product->observations) observer.observe(result.steps.back(), number, *product->observations);
    ++number;
    archive.update(result);
  };
  const auto doubts = solver::solve_static(product->problem, steps, newton_options(call), product->result, context.counters, live_table(context), after_step);
  warn_of_indefinite_stiffness(call, before, context);
  if (product->problem.contact) warn_of_contact(call, *product->problem.contact, doubts, context);
  return product;
}

}  // namespace comma::commands
