#include "commands/alarms/solve_alarms.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/alarms/doubt_advice.hpp"
#include "commands/concepts.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/stresses/strains.hpp"

namespace comma::commands {

void warn_of_contact(const interpreter::Call& call, const solver::StaticProblem& problem,
                     const solver::ContactDoubts& doubts, Context& context) {
  static const solver::ContactDefinition bounds_alone;
  if (!doubts.loose().empty())
    context.diagnostics.alarm(
        "loose-body",
        fmt::format("{}: beside closed contact {}: how far it has moved so is arbitrary", call.command, doubts.loose()),
        call.span, "hold it by DDL_IMPO, by a weak spring, or by friction");
  for (const solver::ContactDoubt& doubt : doubts.all()) {
    const DoubtAdvice advice =
        advice_on(doubt, problem.contact ? *problem.contact : bounds_alone, *problem.model->mesh);
    context.diagnostics.alarm(advice.code, call.command + ": " + advice.message, call.span, advice.hint);
  }
}

void warn_of_used_up_steps(const interpreter::Call& call, const solver::StepPlan& plan, const ResultConcept& product,
                           Context& context) {
  if (!plan.adaptation || !product.problem.driven.empty() || product.result.steps.empty()) return;
  const double reached = product.result.steps.back().instant;
  if (reached >= plan.instants.back()) return;
  context.diagnostics.alarm("steps-used-up",
                            fmt::format("{}: ends at INST={:.6g} of {:.6g}, after {} steps, the most that are allowed",
                                        call.command, reached, plan.instants.back(), plan.adaptation->most_steps),
                            call.span, "raise NB_PAS_MAXI of DEFI_LIST_INST, or let steps grow");
}

void warn_of_unconverged_steps(const interpreter::Call& call, const std::set<double>& instants, Context& context) {
  if (instants.empty()) return;
  constexpr std::size_t most_shown = 6;
  std::vector<double> shown(
      instants.begin(),
      std::next(instants.begin(), static_cast<std::ptrdiff_t>(std::min(instants.size(), most_shown))));
  const std::string more =
      instants.size() > most_shown ? fmt::format(" and {} more", instants.size() - most_shown) : "";
  context.diagnostics.alarm(
      "not-converged",
      fmt::format("{}: the step{} to INST={}{} did not converge within the iterations allowed and stand{} as the "
                  "iterations left {}, out of balance",
                  call.command, instants.size() > 1 ? "s" : "", fmt::join(shown, ", "), more,
                  instants.size() > 1 ? "" : "s", instants.size() > 1 ? "them" : "it"),
      call.span, "allow more iterations (ITER_GLOB_MAXI), or take shorter steps; ARRET='OUI' stops at the first");
}

void warn_of_turns(const interpreter::Call& call, const ResultConcept& product, Context& context) {
  // Beyond, displacements are off in the third digit where a beam is free to change its length, and forces by E A times
  // this where it is not.
  constexpr double noticeable = 1e-3;
  const auto& behaviours = product.problem.behaviours;
  if (!behaviours || product.result.steps.empty()) return;
  const auto found = product.result.steps.back().fields.find("VARI_ELGA");
  if (found == product.result.steps.back().fields.end()) return;
  const auto& variables = std::get<solver::ElementField>(found->second);
  const int column = variables.component("V3");
  double largest = 0.0;
  int worst = 0;
  for (int cell = 0; column >= 0 && cell < static_cast<int>(behaviours->size()); ++cell) {
    if ((*behaviours)[static_cast<std::size_t>(cell)].kinematics != solver::Kinematics::large_rotations ||
        variables.points(cell) == 0)
      continue;
    if (const double left = variables.at(cell, 0, column); left > largest) {
      largest = left;
      worst = cell;
    }
  }
  if (largest <= noticeable) return;
  context.diagnostics.alarm(
      "coarse-turns",
      fmt::format(
          "{}: beams turn so far in a step (DEFORMATION='GROT_GDEP') that {} is taken for {:.2g} % longer than it is",
          call.command, product.result.mesh().cell_name(worst), 100.0 * largest),
      call.span, "take more steps: half as long ones leave half as much");
}

void warn_of_inverted_cells(const interpreter::Call& call, const ResultConcept& product, double from,
                            Context& context) {
  const auto& behaviours = product.problem.behaviours;
  if (!behaviours) return;
  for (const solver::ResultStep& step : product.result.steps) {
    const auto found = step.fields.find("DEPL");
    if (step.instant < from || found == step.fields.end()) continue;
    const auto cell =
        solver::inverted_cell(*product.problem.model, *behaviours, std::get<solver::NodalField>(found->second));
    if (!cell) continue;
    context.diagnostics.alarm("inside-out",
                              fmt::format("{}: cell {} is turned inside out at t = {:g}: GREEN_LAGRANGE with ELAS has "
                                          "stresses for that, and a body has not",
                                          call.command, product.result.mesh().cell_name(*cell), step.instant),
                              call.span,
                              "take finer cells there, or a law for such compression (ELAS_HYPER; GDEF_LOG)");
    return;
  }
}

void warn_of_unused_stresses(const interpreter::Call& call, const solver::StaticProblem& problem, int cell,
                             solver::UnusedStresses unused, Context& context) {
  const interpreter::Keywords& given = call.factor("ETAT_INIT");
  if (unused == solver::UnusedStresses::mean) {
    context.diagnostics.alarm(
        "unused-stresses",
        fmt::format(
            "{}: the mean of the stresses that ETAT_INIT/SIGM gives cell {} is not its pressure (PRES of DEPL, else "
            "0), which follows from the change of volume with INCO_UP: of SIGM the deviator alone has an effect there",
            call.command, problem.model->mesh->cell_name(cell)),
        given.span_of("SIGM"),
        "give the displacements and pressures (DEPL) that have these stresses, or take INCO_UPG, where SIGM counts as "
        "a whole");
    return;
  }
  const auto has = [&](solver::Relation relation) {
    return problem.behaviours && (*problem.behaviours)[static_cast<std::size_t>(cell)].relation == relation;
  };
  const bool by_strains = !problem.behaviours || has(solver::Relation::hyperelastic);
  const bool by_both =
      has(solver::Relation::isotropic_nonlinear) &&
      (*problem.behaviours)[static_cast<std::size_t>(cell)].kinematics != solver::Kinematics::multiplicative;
  context.diagnostics.alarm("unused-stresses",
                            fmt::format("{}: the stresses that ETAT_INIT/SIGM gives cell {} are not those of its {}, "
                                        "which its law takes: SIGM has no effect there",
                                        call.command, problem.model->mesh->cell_name(cell),
                                        by_strains ? "displacements (DEPL)"
                                        : by_both  ? "displacements (DEPL) less the plastic strains of VARI"
                                                   : "internal variables (VARI)"),
                            given.span_of("SIGM"),
                            by_strains ? "give the displacements that have these stresses"
                            : by_both  ? "give the displacements and internal variables that have these stresses"
                                       : "give the internal variables that belong to them (of DEFORMATION='GDEF_LOG' "
                                         "the last six are the stresses)");
}

void warn_of_indefinite_stiffness(const interpreter::Call& call, const solver::Counters& counters_before,
                                  Context& context) {
  if (call.has("PILOTAGE")) return;  // a path goes beyond limit points
  if (context.counters.indefinite_solutions == counters_before.indefinite_solutions) return;
  if (call.has("CONTACT")) {
    context.diagnostics.alarm(
        "indefinite-stiffness",
        fmt::format(
            "{}: without contact the stiffness is not positive definite: where contact lets go, bodies may give way",
            call.command),
        call.span,
        "compare with another formulation of contact, or with smaller steps: there may be several solutions");
    return;
  }
  context.diagnostics.alarm(
      "indefinite-stiffness",
      fmt::format("{}: the stiffness is not positive definite: some motion gives energy instead of taking it, and the "
                  "solution may be far from that of the body",
                  call.command),
      call.span, "look for springs of negative stiffness; curved TETRA10 with NU near 0.5 need MODELISATION='3D_SI'");
}

}  // namespace comma::commands
