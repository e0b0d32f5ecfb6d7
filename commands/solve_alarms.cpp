#include "commands/solve_alarms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/concepts.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/elements/imposed_strains.hpp"
#include "solver/elements/locking.hpp"
#include "solver/fields/variable_fields.hpp"
#include "solver/fields/variable_names.hpp"
#include "solver/materials/behaviour/hardening.hpp"

namespace comma::commands {

namespace {

/// A message and what to try.
struct Advice {
  std::string code;
  std::string message;
  std::string hint;
};

std::string exact_formulation(const solver::ContactDefinition& contact) {
  return contact.formulation == solver::ContactFormulation::mixed ? "ALGO_CONT='STANDARD'" : "ALGO_CONT='CONTRAINTE'";
}

std::string how_to_follow(const solver::ContactDefinition& contact) {
  switch (contact.geometry_update) {
    case solver::GeometryUpdate::none: return "let the geometry be updated: REAC_GEOM='AUTOMATIQUE'";
    case solver::GeometryUpdate::controlled: return "take more updates (NB_ITER_GEOM), or REAC_GEOM='AUTOMATIQUE'";
    case solver::GeometryUpdate::automatic: break;
  }
  return "write a smaller RESI_GEOM, which is a share of the displacement of the step, or take smaller steps";
}

Advice advice_on(const solver::ContactDoubt& doubt, const solver::ContactDefinition& contact, const solver::Mesh& mesh) {
  const bool is_mixed = contact.formulation == solver::ContactFormulation::mixed;
  const std::string penalty = is_mixed ? "COEF_PENA_CONT" : "E_N";
  const std::string friction_penalty = is_mixed ? "COEF_PENA_FROT" : "E_T";
  const int zone = doubt.zone + 1;
  switch (doubt.kind) {
    case solver::DoubtKind::soft_penalty:
      return {"soft-penalty",
              fmt::format("with {} = {:.3g} the slave nodes of zone {} sink in by {:.3g}, {:.0f} % of what they would without contact: "
                          "contact forces come out too small by about that share",
                          penalty, doubt.penalty, zone, doubt.length, 100.0 * doubt.share),
              fmt::format("take {} = {:.0e}, or an exact method ({})", penalty, doubt.wanted, exact_formulation(contact))};
    case solver::DoubtKind::deep_penalty:
      return {"soft-penalty",
              fmt::format("with {} = {:.3g} the slave nodes of zone {} sink in by {:.3g}, {:.2g} times the size of the slave side", penalty,
                          doubt.penalty, zone, doubt.length, doubt.share),
              fmt::format("take {} = {:.0e}, or an exact method ({})", penalty, doubt.wanted, exact_formulation(contact))};
    case solver::DoubtKind::soft_bound:
      return {"soft-penalty",
              fmt::format("with COEF_PENA = {:.3g} bounds are passed by {:.3g}, {:.0f} % of what they would be without them: forces come out too small by about that share",
                          doubt.penalty, doubt.length, 100.0 * doubt.share),
              fmt::format("take COEF_PENA = {:.0e}, or ALGO_CONT='CONTRAINTE'", doubt.wanted)};
    case solver::DoubtKind::soft_friction:
      return {"soft-friction-penalty",
              fmt::format("with {} = {:.3g} slave nodes of zone {} that stick creep by {:.3g}, {:.0f} % of what they would slip without contact: "
                          "friction comes out too small by about that share",
                          friction_penalty, doubt.penalty, zone, doubt.length, 100.0 * doubt.share),
              fmt::format("take {} = {:.0e}, or {}, where what sticks does not creep", friction_penalty, doubt.wanted,
                          is_mixed ? "ALGO_FROT='STANDARD'" : "FORMULATION='CONTINUE'")};
    case solver::DoubtKind::unshared_friction:
      return {"friction-by-shears",
              fmt::format("no solution was found in which points of zone {} between nodes rub by a share of the limit of friction (R5.03.52): there friction is by shears "
                          "interpolated between the nodes, which is another discretisation",
                          zone),
              "put points on the nodes, where both are the same (INTEGRATION='AUTO' on linear faces), or take smaller steps"};
    case solver::DoubtKind::lowered_augmentation:
      return {"softer-coefficient",
              fmt::format("with COEF_CONT = {:.3g} no states of the points of zone {} hold the law of contact and friction: one of {:.1g} was taken, which is in the solution where faces are partly in contact",
                          doubt.penalty, zone, doubt.wanted),
              fmt::format("take COEF_CONT = {:.0e}, put points on the nodes, where it is not in the solution (INTEGRATION='AUTO' on linear faces), or take smaller steps", doubt.wanted)};
    case solver::DoubtKind::held_overlap:
      return {"held-overlap",
              fmt::format("conditions on displacements hold slave face {} of zone {} inside the master, {:.3g} deep, where the penalty gives no force",
                          mesh.cell_name(doubt.cell), zone, doubt.length),
              "free its nodes along the normal, or take them out of the contact (SANS_GROUP_NO)"};
    case solver::DoubtKind::kept_facet:
      return {"kept-facet",
              fmt::format("from one update of the geometry to the next points of zone {} hop between two facets, or off the surface, {} for one: they are left where they were, beside the facet "
                          "that they face by up to {:.2g} of its size",
                          zone, mesh.node_name(doubt.node), doubt.share),
              "smooth the normals (LISSAGE='OUI'), take smaller steps or a finer master"};
    case solver::DoubtKind::restless_geometry:
      return {"restless-geometry",
              fmt::format("updates of the contact geometry move it to and fro without coming to rest, by {:.2g} of the displacement of a step at most, most at node {}: results are "
                          "known to about that share",
                          doubt.share, mesh.node_name(doubt.node)),
              "smooth the normals (LISSAGE='OUI'), take smaller steps or a finer master, where points hop between two facets; a smaller penalty where its rounding moves them"};
    case solver::DoubtKind::stale_geometry:
      return {"stale-geometry",
              fmt::format("the surfaces of zone {} have moved on since they were paired: the gap at {} is {:.3g} off, {:.0f} % of what contact pushes back",
                          zone, mesh.node_name(doubt.node), doubt.length, 100.0 * doubt.share),
              how_to_follow(contact)};
    case solver::DoubtKind::coarse_face:
      return {"coarse-slave",
              fmt::format("where faces of the slave side of zone {} are partly in contact their points overlap the master by {:.3g} on the mean, {:.0f} % of what contact pushes back: forces come out too small by about that share",
                          zone, doubt.length, 100.0 * doubt.share),
              "refine the slave side there, or put points on the nodes (INTEGRATION='AUTO' on linear faces)"};
    case solver::DoubtKind::passed_master: break;
  }
  const std::string hint = is_mixed ? "make the finer side the slave, take more points (INTEGRATION='NCOTES', ORDRE_INT), or averages (ALGO_CONT='LAC')"
                                    : "make the finer side the slave, or take FORMULATION='CONTINUE' with ALGO_CONT='LAC'";
  constexpr double nothing_but_rounding = 1e6;  // of what goes through, beside what is pushed back
  if (!(doubt.share < nothing_but_rounding))
    return {"coarse-slave",
            fmt::format("master nodes of zone {} have gone through the slave side, {:.3g} deep on the mean, and contact pushes nothing back: no slave node has faced "
                        "the master",
                        zone, doubt.length),
            std::string("look which way the normals point (VECT_MAIT, VECT_ESCL, ORIE_PEAU), and what DIST_APPA, TOLE_PROJ_EXT and SANS_GROUP_NO leave out; ") +
                (is_mixed ? "" : "or ") + hint};
  return {"coarse-slave",
          fmt::format("master nodes of zone {} go through the slave side between its nodes, {:.3g} deep on the mean, {:.0f} % of what contact pushes "
                      "back: forces come out too small or motions too large by about that share",
                      zone, doubt.length, 100.0 * doubt.share),
          hint};
}

}  // namespace

void warn_of_contact(const interpreter::Call& call, const solver::StaticProblem& problem, const solver::ContactDoubts& doubts, Context& context) {
  static const solver::ContactDefinition bounds_alone;
  for (const solver::ContactDoubt& doubt : doubts.all()) {
    const Advice advice = advice_on(doubt, problem.contact ? *problem.contact : bounds_alone, *problem.model->mesh);
    context.diagnostics.alarm(advice.code, call.command + ": " + advice.message, call.span, advice.hint);
  }
}

void warn_of_unconverged_steps(const interpreter::Call& call, const std::set<double>& instants, Context& context) {
  if (instants.empty()) return;
  constexpr std::size_t most_shown = 6;
  std::vector<double> shown(instants.begin(), std::next(instants.begin(), static_cast<std::ptrdiff_t>(std::min(instants.size(), most_shown))));
  const std::string more = instants.size() > most_shown ? fmt::format(" and {} more", instants.size() - most_shown) : "";
  context.diagnostics.alarm("not-converged",
                            fmt::format("{}: the step{} to INST={}{} did not converge within the iterations allowed and stand{} as the iterations left {}, out of balance", call.command,
                                        instants.size() > 1 ? "s" : "", fmt::join(shown, ", "), more, instants.size() > 1 ? "" : "s", instants.size() > 1 ? "them" : "it"),
                            call.span, "allow more iterations (ITER_GLOB_MAXI), or take shorter steps; ARRET='OUI' stops at the first");
}

void warn_of_cells_without_behaviour(const interpreter::Call& call, const solver::Model& model, Context& context) {
  if (call.factors("COMPORTEMENT").empty()) return;
  std::vector<bool> named(model.formulations.size(), false);
  for (const interpreter::Keywords& keywords : call.factors("COMPORTEMENT")) {
    if (!names_a_place(keywords, cell_places)) return;
    for (const int cell : selected_cells(keywords, *model.mesh)) named[static_cast<std::size_t>(cell)] = true;
  }
  int count = 0, first = -1;
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell) {
    if (named[static_cast<std::size_t>(cell)] || model.components_of(cell) == 0 || model.is_skin(cell)) continue;
    if (count++ == 0) first = cell;
  }
  if (count == 0) return;
  context.diagnostics.alarm("no-behaviour", fmt::format("{}: COMPORTEMENT leaves out {} cell{}, {} the first: what it leaves out is elastic, in small strains", call.command, count, count == 1 ? "" : "s", model.mesh->cell_name(first)),
                            call.factors("COMPORTEMENT").front().span, "name all cells that carry stiffness, those with RELATION='ELAS' too");
}

void warn_of_turns(const interpreter::Call& call, const ResultConcept& product, Context& context) {
  // Beyond, displacements are off in the third digit where a beam is free to change its length, and forces by E A times this where it is not.
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
    if ((*behaviours)[static_cast<std::size_t>(cell)].kinematics != solver::Kinematics::large_rotations || variables.points(cell) == 0) continue;
    if (const double left = variables.at(cell, 0, column); left > largest) {
      largest = left;
      worst = cell;
    }
  }
  if (largest <= noticeable) return;
  context.diagnostics.alarm("coarse-turns",
                            fmt::format("{}: beams turn so far in a step (DEFORMATION='GROT_GDEP') that {} is taken for {:.2g} % longer than it is", call.command,
                                        product.result.mesh().cell_name(worst), 100.0 * largest),
                            call.span, "take more steps: half as long ones leave half as much");
}

void warn_of_locking(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  const auto risk = solver::find_locking(*problem.model, *problem.materials);
  if (!risk) return;
  const solver::Mesh& mesh = *problem.model->mesh;
  context.diagnostics.alarm(
      "near-incompressible",
      fmt::format("{}: NU = {} in {} fully integrated cells, {} ({}) the first: such cells lock, displacements may come out far too small",
                  call.command, risk->poisson, risk->cells, mesh.cell_name(risk->first_cell),
                  solver::name_of(mesh.cell_types[static_cast<std::size_t>(risk->first_cell)])),
      call.span, "use quadratic cells with MODELISATION='D_PLAN_INCO_UP', 'AXIS_INCO_UP' or '3D_INCO_UP', or with fewer points (D_PLAN_SI, AXIS_SI, 3D_SI), and compare two meshes");
}

void warn_of_repeated_loads(const interpreter::Call& call, Context& context) {
  if (!call.has("EXCIT")) return;
  std::set<const interpreter::Concept*> seen;
  for (const interpreter::Keywords& excitation : call.factors("EXCIT")) {
    const interpreter::ConceptPtr& load = excitation.concept_of("CHARGE");
    if (seen.insert(load.get()).second) continue;
    context.diagnostics.alarm("repeated-load", fmt::format("{}: EXCIT names the load {} more than once: it counts as often", call.command, load->name), excitation.span_of("CHARGE"),
                              "name it once; where two functions of time shall act on it, add them up (CALC_FONCTION, COMB)");
  }
}

namespace {

bool has_flow(const solver::StaticProblem& problem) {
  return problem.behaviours && std::ranges::any_of(*problem.behaviours, [](const solver::CellBehaviour& each) {
    return each.relation != solver::Relation::elastic && each.relation != solver::Relation::hyperelastic;
  });
}

}  // namespace

namespace {

bool has_mass(const solver::Model& model, int cell) {
  const solver::Formulation formulation = model.formulations[static_cast<std::size_t>(cell)];
  return !model.is_skin(cell) && (solver::continuum_dimension(formulation) > 0 || solver::is_bar(formulation) || solver::is_beam(formulation) || solver::is_plate(formulation));
}

/// As given; null where none is.
const solver::Elasticity* elasticity_of(const solver::StaticProblem& problem, int cell) {
  const auto& material = problem.materials->by_cell[static_cast<std::size_t>(cell)];
  return material && material->elasticity ? &*material->elasticity : nullptr;
}

bool is_missing(const solver::Property& property) { return property.is_constant() && property(solver::MaterialPoint()) == 0.0; }

bool lacks_density(const solver::StaticProblem& problem, int cell) {
  const solver::Elasticity* elasticity = has_mass(*problem.model, cell) ? elasticity_of(problem, cell) : nullptr;
  return elasticity != nullptr && std::visit([](const auto& each) { return is_missing(each.density); }, *elasticity);
}

void warn_of_missing_density(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  std::set<int> weightless;
  const auto look_at = [&](const std::vector<int>& cells) {
    std::ranges::copy_if(cells, std::inserter(weightless, weightless.end()), [&](int cell) { return lacks_density(problem, cell); });
  };
  for (const auto* loads : {&problem.loads, &problem.driven}) {
    for (const solver::AppliedLoad& applied : *loads) {
      for (const solver::GravityLoad& each : applied.load->gravities) look_at(each.cells);
      for (const solver::RotationLoad& each : applied.load->rotations) look_at(each.cells);
    }
  }
  if (weightless.empty()) return;
  context.diagnostics.alarm("no-density",
                            fmt::format("{}: PESANTEUR or ROTATION acts on {} cell{} whose material has no RHO, {} the first: no force comes of it", call.command, weightless.size(),
                                        weightless.size() == 1 ? "" : "s", problem.model->mesh->cell_name(*weightless.begin())),
                            call.span, "give RHO in DEFI_MATERIAU (ELAS)");
}

/// A variable of which a material that is constant takes a strain or nothing.
struct StrainingVariable {
  solver::Parameter parameter;
  const char* name;
  const solver::Property& (*coefficient)(const solver::IsotropicElasticity&);
  const char* keyword;
};

constexpr std::array<StrainingVariable, 2> straining_variables = {
    {{solver::Parameter::temperature, "TEMP", [](const solver::IsotropicElasticity& elasticity) -> const solver::Property& { return elasticity.expansion.coefficient; }, "ALPHA"},
     {solver::Parameter::drying, "SECH", [](const solver::IsotropicElasticity& elasticity) -> const solver::Property& { return elasticity.drying_shrinkage; }, "K_DESSIC"}}};

bool ignores(const solver::StaticProblem& problem, int cell, const StrainingVariable& variable) {
  const solver::Elasticity* elasticity = has_mass(*problem.model, cell) ? elasticity_of(problem, cell) : nullptr;
  const auto* isotropic = elasticity != nullptr ? std::get_if<solver::IsotropicElasticity>(elasticity) : nullptr;
  if (isotropic == nullptr || !is_missing(variable.coefficient(*isotropic))) return false;
  const solver::Relation relation = problem.behaviours && !problem.behaviours->empty() ? (*problem.behaviours)[static_cast<std::size_t>(cell)].relation : solver::Relation::elastic;
  return solver::is_constant(*isotropic, problem.materials->by_cell[static_cast<std::size_t>(cell)]->plasticity, relation);
}

void warn_of_missing_expansion(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  for (const StrainingVariable& variable : straining_variables) {
    for (const solver::CommandVariable& given : problem.materials->variables) {
      if (given.variable != variable.parameter) continue;
      const auto idle = [&](int cell) { return ignores(problem, cell, variable); };
      std::vector<int> cells = given.cells;
      if (cells.empty())
        for (int cell = 0; cell < problem.model->mesh->cell_count(); ++cell) cells.push_back(cell);
      const auto first = std::ranges::find_if(cells, idle);
      if (first == cells.end()) continue;
      context.diagnostics.alarm("no-expansion",
                                fmt::format("{}: {} is given on {}, whose material has no {} and nothing that depends on it: no strain comes of it", call.command, variable.name,
                                            problem.model->mesh->cell_name(*first), variable.keyword),
                                call.span, fmt::format("give {} in DEFI_MATERIAU (ELAS)", variable.keyword));
      break;
    }
  }
}

}  // namespace

void warn_of_missing_data(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.materials) return;
  warn_of_missing_density(call, problem, context);
  warn_of_missing_expansion(call, problem, context);
}

void warn_of_strained_start(const interpreter::Call& call, const solver::StaticProblem& problem, double instant, Context& context) {
  if (problem.initial || !problem.materials || problem.materials->variables.empty()) return;
  const solver::VariableState state(*problem.model->mesh, problem.materials->variables, instant);
  const solver::FieldInput input{*problem.model, *problem.materials, *problem.properties, state};
  const solver::ElementField strains = solver::variable_strain_field(input);
  constexpr double rounding = 1e-12;
  const auto found = std::ranges::find_if(strains.values, [](double value) { return std::abs(value) > rounding; });
  if (found == strains.values.end()) return;
  context.diagnostics.alarm("strained-start",
                            fmt::format("{}: at the first instant, {:.6g}, command variables differ from their reference values (strain {:.3g}): elasticity without a memory takes the whole strain, "
                                        "laws with a memory and large strains what changes from there",
                                        call.command, instant, *found),
                            call.span, "begin at an instant where the variables have their reference values (VALE_REF)");
}

void warn_of_initial_strains(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  const auto gives_strains = [](const solver::AppliedLoad& each) { return solver::gives_initial_strains(*each.load); };
  if (!has_flow(problem) || std::ranges::none_of(problem.loads, gives_strains)) return;
  context.diagnostics.alarm("initial-strains",
                            fmt::format("{}: laws that flow see strains less the initial ones (PRE_EPSI); what Code_Aster does beyond the yield point is not known", call.command),
                            call.span, "give strains that are known beforehand as a command variable (AFFE_VARC, EPSA)");
}

// A result may have been kept without some of its fields (ARCHIVAGE, CHAM_EXCLU).
void warn_of_missing_state(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.initial || !call.factor("ETAT_INIT").has("EVOL_NOLI")) return;
  const interpreter::Keywords& given = call.factor("ETAT_INIT");
  const auto warn = [&](const char* field, const char* what, const char* keyword) {
    context.diagnostics.alarm("no-initial-field", fmt::format("{}: the step of {} that it starts from holds no {}: {} begin at zero", call.command, given.concept_of("EVOL_NOLI")->name, field, what),
                              given.span_of("EVOL_NOLI"), fmt::format("keep {} in the result (ARCHIVAGE, CHAM_EXCLU), or give the field by {}", field, keyword));
  };
  if (!problem.initial->displacement) warn("DEPL", "displacements", "DEPL");
  if (!problem.initial->stresses) warn("SIEF_ELGA", "stresses", "SIGM");
}

// What flowed in the step before is not kept in results.
void warn_of_forgotten_flow(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.initial || call.text("METHODE") != "IMPLEX" || !has_flow(problem)) return;
  context.diagnostics.alarm("forgotten-flow", fmt::format("{}: METHODE='IMPLEX' does not know what flowed before ETAT_INIT: its first step is elastic", call.command), call.factor("ETAT_INIT").span,
                            "begin with a short step, or go on without ETAT_INIT");
}

void warn_of_lost_variables(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.initial || !problem.initial->displacement || problem.initial->variables || !has_flow(problem)) return;
  context.diagnostics.alarm("no-internal-variables",
                            fmt::format("{}: ETAT_INIT gives displacements without internal variables: hardening and plastic strains begin at zero", call.command),
                            call.factor("ETAT_INIT").span, "give VARI too, or keep VARI_ELGA in the result (ARCHIVAGE, CHAM_EXCLU)");
}

void warn_of_released_points(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.contact || !problem.initial || !problem.initial->displacement || call.factor("ETAT_INIT").has("EVOL_NOLI")) return;
  if (std::ranges::none_of(problem.contact->zones, [](const solver::ContactZone& zone) { return zone.mixed.bilateral; })) return;
  context.diagnostics.alarm("released-points", fmt::format("{}: ETAT_INIT gives fields, which do not say what points GLISSIERE holds: of those that touch, rounding decides", call.command),
                            call.factor("ETAT_INIT").span, "give the result and its step (EVOL_NOLI)");
}

void warn_of_other_laws(const interpreter::Call& call, const solver::BehaviourOfCells* before, const solver::StaticProblem& problem, Context& context) {
  if (before == nullptr || !problem.behaviours || !problem.initial || !problem.initial->variables) return;
  const solver::BehaviourOfCells& now = *problem.behaviours;
  const std::vector<std::string> none = {"VIDE"};
  for (std::size_t cell = 0; cell < std::min(before->size(), now.size()); ++cell) {
    if ((*before)[cell] == now[cell]) continue;
    const auto had = solver::variable_names((*before)[cell]), has = solver::variable_names(now[cell]);
    if (had == has || had == none || has == none || had.empty() || has.empty()) continue;
    context.diagnostics.alarm("other-variables",
                              fmt::format("{}: the law of cell {} had the internal variables {} and now has {}: they are taken by their numbers", call.command,
                                          problem.model->mesh->cell_name(static_cast<int>(cell)), fmt::join(had, ", "), fmt::join(has, ", ")),
                              call.factor("ETAT_INIT").span, "go on with the same law, or give VARI that belong to the new one");
    return;
  }
}

void warn_of_indefinite_stiffness(const interpreter::Call& call, const solver::Counters& counters_before, Context& context) {
  if (call.has("PILOTAGE")) return;  // a path goes beyond limit points
  if (context.counters.indefinite_factorisations == counters_before.indefinite_factorisations) return;
  if (call.has("CONTACT")) {
    context.diagnostics.alarm("indefinite-stiffness",
                              fmt::format("{}: without contact the stiffness is not positive definite: where contact lets go, bodies may give way", call.command),
                              call.span, "compare with another formulation of contact, or with smaller steps: there may be several solutions");
    return;
  }
  context.diagnostics.alarm(
      "indefinite-stiffness",
      fmt::format("{}: the stiffness is not positive definite: some motion gives energy instead of taking it, and the solution may be "
                  "far from that of the body",
                  call.command),
      call.span, "look for springs of negative stiffness; curved TETRA10 with NU near 0.5 need MODELISATION='3D_SI'");
}

}  // namespace comma::commands
