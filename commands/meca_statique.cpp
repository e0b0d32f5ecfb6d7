#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands/alarms/scene_alarms.hpp"
#include "commands/alarms/solve_alarms.hpp"
#include "commands/analysis/problem_building.hpp"
#include "commands/commands.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/nonlinear/linear_static_analysis.hpp"

namespace comma::commands {

namespace {

std::vector<double> instants(const Call& call) {
  if (!call.has("LIST_INST")) return {call.real("INST")};
  std::vector<double> chosen;
  constexpr double same_instant = 1e-6;
  for (const double instant : call.data<ListConcept>("LIST_INST").values) {
    if (!call.has("INST_FIN") || instant <= call.real("INST_FIN") + same_instant * std::abs(call.real("INST_FIN")))
      chosen.push_back(instant);
  }
  if (!chosen.empty()) return chosen;
  throw interpreter::DiagnosticError("wrong-order", "MECA_STATIQUE: every instant of LIST_INST lies beyond INST_FIN",
                                     call.span_of("INST_FIN"));
}

/// The instants that the result to go on with does not hold yet.
std::vector<double> new_instants(std::vector<double> instants, const solver::Result& result) {
  constexpr double same_instant = 1e-6;
  std::erase_if(instants, [&](double instant) {
    return std::ranges::any_of(result.steps, [&](const solver::ResultStep& step) {
      return std::abs(step.instant - instant) <= same_instant * std::abs(instant);
    });
  });
  return instants;
}

void warn_of_statics(const Call& call, const solver::StaticProblem& problem, Context& context) {
  warn_of_scene(call, problem, context);
  warn_of_loads_at_the_start(call, problem, instants(call).front(), context);
}

solver::LinearStaticOptions options_of(const Call& call) {
  const SolverChoice choice = solver_choice(call);
  return {choice.method, choice.options, call.text("OPTION") == "SIEF_ELGA"};
}

}  // namespace

Product prepare_meca_statique(const Call& call, Context& context) {
  const solver::StaticProblem problem = static_problem(call);
  check_multipliers(call, instants(call));
  solver::require_solvable(problem, options_of(call));
  if (context.only_checks) warn_of_statics(call, problem, context);
  return nullptr;
}

Product meca_statique(const Call& call, Context& context) {
  auto product = call.reuse ? to_go_on_with(call) : std::make_shared<ResultConcept>();
  product->problem = static_problem(call);
  product->result.model = product->problem.model;
  product->sources = numbered_sources(call);
  const solver::LinearStaticOptions options = options_of(call);
  context.console.progress(fmt::format("MECA_STATIQUE {}", call.result->name));
  const std::vector<double> asked = instants(call), wanted = new_instants(asked, product->result);
  if (wanted.size() < asked.size())
    context.diagnostics.alarm("known-instants",
                              fmt::format("MECA_STATIQUE: {} has {} of the {} instants already, and they are not "
                                          "computed anew: what is given here counts at the others alone",
                                          call.result->name, asked.size() - wanted.size(), asked.size()),
                              call.has("LIST_INST") ? call.span_of("LIST_INST") : call.span,
                              "make another result, or name other instants (INST, LIST_INST)");
  // What has been solved stays readable although a later instant fails.
  call.result->data = product;
  warn_of_statics(call, product->problem, context);
  const solver::Counters before = context.counters;
  solver::solve_linear_static(product->problem, wanted, options, product->result, context.counters);
  warn_of_indefinite_stiffness(call, before, context);
  return product;
}

}  // namespace comma::commands
