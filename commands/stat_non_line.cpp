#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "commands/alarms/scene_alarms.hpp"
#include "commands/alarms/solve_alarms.hpp"
#include "commands/analysis/archiving.hpp"
#include "commands/analysis/behaviour_reading.hpp"
#include "commands/analysis/initial_state.hpp"
#include "commands/analysis/observation.hpp"
#include "commands/analysis/path_reading.hpp"
#include "commands/analysis/problem_building.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "commands/analysis/stability_reading.hpp"
#include "commands/analysis/step_record.hpp"
#include "commands/bounds.hpp"
#include "commands/commands.hpp"
#include "commands/nearest.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;

solver::StaticProblem problem_of(const Call& call, const InitialStateChoice& initial) {
  solver::StaticProblem problem = static_problem(call);
  problem.initial = initial.state;
  problem.behaviours = behaviours_of(call, *problem.model, problem.initial.get(),
                                     problem.materials && !problem.materials->variables.empty());
  if (!call.has("CONTACT")) return problem;
  const auto& contact_concept = call.data<ContactConcept>("CONTACT");
  require_mesh(call, "CONTACT", contact_concept.model->mesh.get(), *problem.model->mesh);
  const auto& conditions = contact_concept.conditions;
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

// Without the first instant written, steps go on from that of the initial state.
void start_at(std::optional<double> instant, const Keywords& increment, solver::StepPlan& plan) {
  if (!instant || increment.given("NUME_INST_INIT") || increment.given("INST_INIT")) return;
  const double reach = increment.real("PRECISION") * std::abs(*instant);
  std::erase_if(plan.instants, [&](double each) { return each <= *instant + reach; });
  plan.instants.insert(plan.instants.begin(), *instant);
  if (plan.instants.size() > 1) return;
  throw DiagnosticError(
      "wrong-order",
      fmt::format("STAT_NON_LINE: no instant of INCREMENT lies beyond that of the initial state, {}", *instant),
      increment.span, "give a list that goes further, or INST_INIT");
}

// The plan with those instants that INCREMENT keeps of its list; the first is the initial state.
solver::StepPlan steps_of(const Keywords& increment, std::optional<double> initial) {
  solver::StepPlan plan = whole_plan(increment);
  const std::vector<double> all = plan.instants;
  const auto index_of = [&](const char* number, const char* instant, std::size_t otherwise) {
    if (increment.given(number)) {
      const auto index = increment.integer(number);
      if (index >= 0 && index < static_cast<std::int64_t>(all.size())) return static_cast<std::size_t>(index);
      throw DiagnosticError("unknown-step", fmt::format("LIST_INST has the numbers 0 to {}", all.size() - 1),
                            increment.span_of(number));
    }
    if (!increment.given(instant)) return otherwise;
    const double wanted = increment.real(instant);
    const InstantTolerance tolerance{increment.real("PRECISION")};
    if (const auto nearest = nearest_within(all, wanted, tolerance.reach(wanted))) return *nearest;
    throw DiagnosticError("unknown-step", fmt::format("LIST_INST has no instant {}", wanted),
                          increment.span_of(instant), fmt::format("it goes from {} to {}", all.front(), all.back()));
  };
  const std::size_t first = index_of("NUME_INST_INIT", "INST_INIT", 0);
  const std::size_t last = index_of("NUME_INST_FIN", "INST_FIN", all.size() - 1);
  if (last <= first) {
    throw DiagnosticError("wrong-order", "STAT_NON_LINE: INCREMENT leaves no step to compute", increment.span,
                          "the last instant must lie beyond the first");
  }
  plan.instants.assign(all.begin() + static_cast<std::ptrdiff_t>(first),
                       all.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  start_at(initial, increment, plan);
  return plan;
}

// comma makes the tangent again at each iteration unless REAC_ITER is written, or REAC_INCR=0 says that it is never
// made again.
solver::TangentPolicy tangent_policy(const Keywords& newton) {
  const auto kind_named = [](const std::string& word) {
    return word == "ELASTIQUE" ? solver::TangentKind::elastic : solver::TangentKind::tangent;
  };
  solver::TangentPolicy policy;
  policy.correction = kind_named(newton.text("MATRICE"));
  const std::string prediction = newton.has("PREDICTION") ? newton.text("PREDICTION") : newton.text("MATRICE");
  policy.prediction =
      prediction == "TANGENTE" || prediction == "ELASTIQUE" ? kind_named(prediction) : policy.correction;
  policy.steps = static_cast<int>(newton.integer("REAC_INCR"));
  policy.elastic_below = newton.real("PAS_MINI_ELAS");
  policy.elastic_iterations = static_cast<int>(newton.integer("REAC_ITER_ELAS"));
  const bool never = policy.steps == 0;  // also not within a step
  if (newton.given("REAC_ITER") || never) policy.iterations = static_cast<int>(newton.integer("REAC_ITER"));
  return policy;
}

solver::LineSearch line_search(const Call& call) {
  const Keywords& search = call.factor("RECH_LINEAIRE");
  const bool along_path = search.text("METHODE") == "PILOTAGE";
  if (along_path != call.has("PILOTAGE")) {
    throw DiagnosticError("contradictory-keywords",
                          along_path ? "STAT_NON_LINE: RECH_LINEAIRE/METHODE='PILOTAGE' needs the keyword PILOTAGE"
                                     : "STAT_NON_LINE: with PILOTAGE the line search has a method of its own",
                          search.span, along_path ? "write METHODE='CORDE' or 'MIXTE'" : "write METHODE='PILOTAGE'");
  }
  require_order(search, "RHO_MIN", "RHO_MAX");
  solver::LineSearch options;
  options.bracketed = search.text("METHODE") == "MIXTE";
  options.tolerance = search.real("RESI_LINE_RELA");
  options.max_iterations = static_cast<int>(search.integer("ITER_LINE_MAXI"));
  options.smallest = search.real("RHO_MIN");
  options.largest = search.real("RHO_MAX");
  options.excluded = search.real("RHO_EXCL");
  return options;
}

void read_newton(const Keywords& newton, const solver::Mesh& mesh, solver::NewtonOptions& options) {
  options.tangent = tangent_policy(newton);
  if (!newton.has("PREDICTION")) return;
  if (newton.text("PREDICTION") == "EXTRAPOLE") options.guess = solver::StepGuess::extrapolate;
  if (newton.text("PREDICTION") != "DEPL_CALCULE") return;
  const auto& handle = newton.concept_of("EVOL_NOLI");
  const auto& guessed = interpreter::data_of<ResultConcept>(handle, "EVOL_NOLI");
  require_mesh(newton, "EVOL_NOLI", &guessed.result.mesh(), mesh);
  options.guessed = std::shared_ptr<const solver::Result>(handle->data, &guessed.result);
}

// Driven loads and what finds their intensity come together.
void check_driven(const Call& call, const solver::StaticProblem& problem) {
  if (problem.driven.empty() == !call.has("PILOTAGE")) return;
  if (problem.driven.empty())
    throw DiagnosticError("missing-keyword",
                          "STAT_NON_LINE: PILOTAGE seeks the intensity of a load, and no load is driven",
                          call.factor("PILOTAGE").span, "give a load of EXCIT TYPE_CHARGE='FIXE_PILO'");
  throw DiagnosticError(
      "missing-keyword",
      "STAT_NON_LINE: a load has TYPE_CHARGE='FIXE_PILO', and nothing says how its intensity is found", call.span,
      "give PILOTAGE, or leave out TYPE_CHARGE");
}

void read_reference(const Keywords& convergence, solver::NewtonOptions& options) {
  if (!convergence.given("RESI_REFE_RELA")) return;
  options.referred_residual = convergence.real("RESI_REFE_RELA");
  if (convergence.given("SIGM_REFE")) options.reference.stress = convergence.real("SIGM_REFE");
  if (convergence.given("EPSI_REFE")) options.reference.strain = convergence.real("EPSI_REFE");
  if (convergence.given("EFFORT_REFE")) options.reference.force = convergence.real("EFFORT_REFE");
  if (convergence.given("MOMENT_REFE")) options.reference.moment = convergence.real("MOMENT_REFE");
}

solver::NewtonOptions newton_options(const Call& call, const solver::Mesh& mesh) {
  solver::NewtonOptions options;
  if (call.has("NEWTON")) read_newton(call.factor("NEWTON"), mesh, options);
  options.extrapolates_flow = call.text("METHODE") == "IMPLEX";
  if (call.has("PILOTAGE")) options.path = path_control(call, mesh);
  if (call.has("RECH_LINEAIRE")) options.line_search = line_search(call);
  if (call.has("CONVERGENCE")) {
    const Keywords& convergence = call.factor("CONVERGENCE");
    const bool relative = convergence.given("RESI_GLOB_RELA");
    const bool absolute = convergence.given("RESI_GLOB_MAXI");
    if (relative) options.relative_residual = convergence.real("RESI_GLOB_RELA");
    if (absolute) options.absolute_residual = convergence.real("RESI_GLOB_MAXI");
    read_reference(convergence, options);
    if (convergence.given("RESI_COMP_RELA")) options.component_residual = convergence.real("RESI_COMP_RELA");
    if ((absolute || options.referred_residual || options.component_residual) && !relative)
      options.relative_residual.reset();
    options.one_criterion = convergence.text("VERIF") == "AU_MOINS_UN";
    if (convergence.has("ITER_GLOB_MAXI"))
      options.max_iterations = static_cast<int>(convergence.integer("ITER_GLOB_MAXI"));
    if (convergence.has("ITER_GLOB_ELAS"))
      options.max_elastic_iterations = static_cast<int>(convergence.integer("ITER_GLOB_ELAS"));
  }
  const SolverChoice choice = solver_choice(call);
  // Each contact row is a right-hand side, and one factor serves them all.
  const bool has_many_sides = call.has("CONTACT") && choice.method == solver::LinearMethod::conjugate_gradient;
  options.method = has_many_sides ? solver::LinearMethod::cholmod : choice.method;
  options.linear = choice.options;
  return options;
}

// The result to go on with, up to the step that the computation starts from.
std::shared_ptr<ResultConcept> continued(const Call& call, const InitialStateChoice& initial) {
  if (!initial.state) {
    throw DiagnosticError("missing-keyword", "STAT_NON_LINE: with reuse= the computation goes on from an initial state",
                          call.span, "give ETAT_INIT=_F(EVOL_NOLI=" + call.result->name + ")");
  }
  return to_go_on_with(call, initial.order);
}

// Whether all steps converge or not.
void settle_driven(ResultConcept* product) { settle_driven_loads(*product); }

void show_header(const Call& call, const Context& context) {
  context.console.progress("STAT_NON_LINE " + call.result->name);
  context.console.progress("     instant iter relative absolute  worst              active changes     depth");
}

// The live table. Iterations of a step count from 1 anew where the geometry of contact has been updated.
class LiveTable {
 public:
  explicit LiveTable(const Console& console) : console_(console) {}

  void show(const solver::IterationReport& report) {
    const bool begins_anew = report.event.empty() && report.iteration == 1 && report.instant == instant_;
    instant_.reset();
    if (!report.event.empty()) return show_event(report);
    instant_ = report.instant;
    if (begins_anew && !explained_)
      console_.progress("  * iterations begin anew, as a rule on surfaces paired as they have moved");
    explained_ = explained_ || begins_anew;
    // Where nothing is loaded there is no share of the loads.
    const std::string relative = report.relative_residual < 0.0 ? "-" : fmt::format("{:.1e}", report.relative_residual);
    const std::string depth = report.penetration ? fmt::format("{:.2e}", *report.penetration) : "-";
    console_.progress(fmt::format("{} {:>10.5g} {:>4} {:>8} {:>8.1e}  {:<18} {:>6} {:>7} {:>9}",
                                  begins_anew ? '*' : ' ', report.instant, report.iteration, relative,
                                  report.absolute_residual, report.worst, report.active_conditions,
                                  report.contact_changes, depth));
  }

 private:
  void show_event(const solver::IterationReport& report) const {
    console_.progress("  " + report.event);
    if (!report.detail.empty()) console_.detail("    " + report.detail);
  }

  const Console& console_;
  std::optional<double> instant_;  ///< of the iteration before
  bool explained_ = false;
};

solver::IterationObserver live_table(const Context& context) {
  if (context.console.verbosity() == Verbosity::quiet) return {};
  return [table = LiveTable(context.console)](const solver::IterationReport& report) mutable { table.show(report); };
}

// What the last iteration of a step leaves of the equations; the initial state has had none.
void keep_residuals(const solver::IterationReport& last, solver::ResultStep& step) {
  if (last.iteration == 0) return;
  step.parameters["RESI_GLOB_MAXI"] = last.absolute_residual;
  if (last.relative_residual >= 0.0) step.parameters["RESI_GLOB_RELA"] = last.relative_residual;
}

// All that the keywords say.
struct Scene {
  InitialStateChoice initial;
  std::shared_ptr<ResultConcept> product;
  solver::NewtonOptions options;
  solver::StepPlan steps;
};

Scene scene_of(const Call& call) {
  const InitialStateChoice initial = initial_state(call);
  auto product = call.reuse ? continued(call, initial) : std::make_shared<ResultConcept>();
  product->problem = problem_of(call, initial);
  product->result.model = product->problem.model;
  product->sources = numbered_sources(call);
  check_driven(call, product->problem);
  complete_variables(product->problem, initial.behaviours.get());
  check_initial_stresses(call, product->problem);
  check_turned_beams(call, product->problem, initial.behaviours.get());
  solver::NewtonOptions options = newton_options(call, product->result.mesh());
  solver::StepPlan steps = steps_of(call.factor("INCREMENT"), initial.instant);
  if (steps.adaptation) steps.adaptation->usual_iterations = options.max_iterations / 2;
  options.stability = stability_analysis(call, *product);
  return {initial, product, options, steps};
}

// INST= then names several steps of the result.
void warn_of_instants_that_go_back(const Call& call, const Scene& scene, Context& context) {
  const std::vector<solver::ResultStep>& kept = scene.product->result.steps;
  if (kept.empty()) return;
  const double reached = kept.back().instant, next = scene.steps.instants[1];
  if (next > reached + call.factor("INCREMENT").real("PRECISION") * std::abs(reached)) return;
  context.diagnostics.alarm("instants-go-back",
                            fmt::format("STAT_NON_LINE: {} goes on to the instant {:.6g}, and its steps reach {:.6g} "
                                        "already: what asks for an instant in between finds the earlier step",
                                        call.result->name, next, reached),
                            call.factor("INCREMENT").span,
                            "start from the step of that instant (ETAT_INIT, INST), which takes the place of later "
                            "ones, or make another result");
}

void warn_of(const Call& call, const Scene& scene, Context& context) {
  warn_of_instants_that_go_back(call, scene, context);
  warn_of_nonlinear_scene(call, scene.product->problem, scene.steps.instants.front(), scene.initial.behaviours.get(),
                          context);
}

}  // namespace

Product prepare_stat_non_line(const Call& call, Context& context) {
  const Scene scene = scene_of(call);
  const Observer observer(call, *scene.product);
  const Archive archive(call);
  solver::require_solvable(scene.product->problem, scene.steps, scene.options);
  if (!call.has("PILOTAGE")) check_multipliers(call, std::span(scene.steps.instants).subspan(1));
  if (context.only_checks) warn_of(call, scene, context);
  return nullptr;
}

Product stat_non_line(const Call& call, Context& context) {
  Scene scene = scene_of(call);
  const auto& product = scene.product;
  if (!call.has("PILOTAGE")) check_multipliers(call, std::span(scene.steps.instants).subspan(1));
  show_header(call, context);
  // What has converged stays readable although the computation goes on to fail.
  call.result->data = product;
  warn_of(call, scene, context);
  const solver::Counters before = context.counters;
  Observer observer(call, *product);
  if (!observer.empty() && !product->observations) product->observations.emplace();
  Archive archive(call);
  StepRecorder recorder(call, *product, scene.steps.instants.front());
  std::vector<double> computed;
  solver::IterationReport last;
  const auto iterated = [&last, show = live_table(context)](const solver::IterationReport& report) {
    if (report.event.empty()) last = report;
    if (show) show(report);
  };
  // What goes on with steps that are there begins with the last of them.
  const bool goes_on = !product->result.steps.empty();
  if (goes_on && product->observations) {
    observer.observe(0, product->observations->table);
    product->observations->end_step(product->result.steps.back().order);
  }
  const auto after_step = [&, number = goes_on ? 1 : 0](solver::Result& result) mutable {
    if (product->observations) observer.observe(number, product->observations->table);
    ++number;
    computed.push_back(result.steps.back().instant);
    keep_residuals(last, result.steps.back());
    recorder.take();
    archive.update(result);
    product->computed->end_step(result.steps.back().order);
    if (product->observations) product->observations->end_step(result.steps.back().order);
  };
  std::set<double> unconverged;
  if (call.has("CONVERGENCE") && call.factor("CONVERGENCE").text("ARRET") == "NON")
    scene.options.note_unconverged = [&](double instant) { unconverged.insert(instant); };
  if (call.has("ETAT_INIT") && call.factor("ETAT_INIT").has("SIGM"))
    scene.options.note_unused_stresses = [&](int cell, solver::UnusedStresses unused) {
      warn_of_unused_stresses(call, product->problem, cell, unused, context);
    };
  const auto solve = [&] {
    const std::unique_ptr<ResultConcept, decltype(&settle_driven)> settled(product.get(), settle_driven);
    return solver::solve_static(product->problem, scene.steps, scene.options, product->result, context.counters,
                                iterated, after_step);
  };
  const auto doubts = solve();
  if (const auto missed = archive.missed(computed); !missed.empty())
    context.diagnostics.alarm(
        "unknown-step",
        fmt::format("STAT_NON_LINE: no step ends at {}, which ARCHIVAGE is to keep", fmt::join(missed, ", ")),
        call.factor("ARCHIVAGE").span, "name instants of INCREMENT/LIST_INST");
  observer.warn_of_nothing(computed, context.diagnostics);
  warn_of_unconverged_steps(call, unconverged, context);
  warn_of_used_up_steps(call, scene.steps, *product, context);
  warn_of_indefinite_stiffness(call, before, context);
  warn_of_turns(call, *product, context);
  if (!computed.empty()) warn_of_inverted_cells(call, *product, computed.front(), context);
  warn_of_contact(call, product->problem, doubts, context);
  return product;
}

}  // namespace comma::commands
