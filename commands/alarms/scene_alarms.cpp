#include "commands/alarms/scene_alarms.hpp"

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

void warn_of_locking(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  const auto risk = solver::find_locking(*problem.model, *problem.materials);
  if (!risk) return;
  const solver::Mesh& mesh = *problem.model->mesh;
  context.diagnostics.alarm("near-incompressible",
                            fmt::format("{}: NU = {} in {} fully integrated cells, {} ({}) the first: such cells lock, "
                                        "displacements may come out far too small",
                                        call.command, risk->poisson, risk->cells, mesh.cell_name(risk->first_cell),
                                        solver::name_of(mesh.cell_types[static_cast<std::size_t>(risk->first_cell)])),
                            call.span,
                            "use quadratic cells with MODELISATION='D_PLAN_INCO_UP', 'AXIS_INCO_UP' or '3D_INCO_UP', "
                            "or with fewer points (D_PLAN_SI, AXIS_SI, 3D_SI), and compare two meshes");
}

void warn_of_repeated_loads(const interpreter::Call& call, Context& context) {
  if (!call.has("EXCIT")) return;
  std::set<const interpreter::Concept*> seen;
  for (const interpreter::Keywords& excitation : call.factors("EXCIT")) {
    const interpreter::ConceptPtr& load = excitation.concept_of("CHARGE");
    if (seen.insert(load.get()).second) continue;
    context.diagnostics.alarm(
        "repeated-load",
        fmt::format("{}: EXCIT names the load {} more than once: it counts as often", call.command, load->name),
        excitation.span_of("CHARGE"),
        "name it once; where two functions of time shall act on it, add them up (CALC_FONCTION, COMB)");
  }
}

bool has_flow(const solver::StaticProblem& problem) {
  return problem.behaviours && std::ranges::any_of(*problem.behaviours, [](const solver::CellBehaviour& each) {
           return each.relation != solver::Relation::elastic && each.relation != solver::Relation::hyperelastic;
         });
}

bool has_mass(const solver::Model& model, int cell) {
  const solver::Formulation formulation = model.formulations[static_cast<std::size_t>(cell)];
  return !model.is_skin(cell) && (solver::continuum_dimension(formulation) > 0 || solver::is_bar(formulation) ||
                                  solver::is_beam(formulation) || solver::is_plate(formulation));
}

/// As given; null where none is.
const solver::Elasticity* elasticity_of(const solver::StaticProblem& problem, int cell) {
  const auto& material = problem.materials->by_cell[static_cast<std::size_t>(cell)];
  return material && material->elasticity ? &*material->elasticity : nullptr;
}

bool is_missing(const solver::Property& property) {
  return property.is_constant() && property(solver::MaterialPoint()) == 0.0;
}

bool lacks_density(const solver::StaticProblem& problem, int cell) {
  const solver::Elasticity* elasticity = has_mass(*problem.model, cell) ? elasticity_of(problem, cell) : nullptr;
  return elasticity != nullptr && std::visit([](const auto& each) { return is_missing(each.density); }, *elasticity);
}

void warn_of_no_density(const interpreter::Call& call, const solver::StaticProblem& problem, const std::set<int>& cells,
                        const char* use, const char* effect, Context& context) {
  if (cells.empty()) return;
  context.diagnostics.alarm(
      "no-density",
      fmt::format("{}: {} {} cell{} whose material has no RHO, {} the first: {}", call.command, use, cells.size(),
                  cells.size() == 1 ? "" : "s", problem.model->mesh->cell_name(*cells.begin()), effect),
      call.span, "give RHO in DEFI_MATERIAU (ELAS)");
}

void warn_of_missing_density(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  std::set<int> weightless;
  const auto look_at = [&](const std::vector<int>& cells) {
    std::ranges::copy_if(cells, std::inserter(weightless, weightless.end()),
                         [&](int cell) { return lacks_density(problem, cell); });
  };
  for (const auto* loads : {&problem.loads, &problem.driven}) {
    for (const solver::AppliedLoad& applied : *loads) {
      for (const solver::GravityLoad& each : applied.load->gravities) look_at(each.cells);
      for (const solver::RotationLoad& each : applied.load->rotations) look_at(each.cells);
    }
  }
  warn_of_no_density(call, problem, weightless, "PESANTEUR or ROTATION acts on", "no force comes of it", context);
}

/// A variable of which a material that is constant takes a strain or nothing.
struct StrainingVariable {
  solver::Parameter parameter;
  const char* name;
  const solver::Property& (*coefficient)(const solver::IsotropicElasticity&);
  const char* keyword;
};

constexpr std::array<StrainingVariable, 2> straining_variables = {
    {{solver::Parameter::temperature, "TEMP",
      [](const solver::IsotropicElasticity& elasticity) -> const solver::Property& {
        return elasticity.expansion.coefficient;
      },
      "ALPHA"},
     {solver::Parameter::drying, "SECH",
      [](const solver::IsotropicElasticity& elasticity) -> const solver::Property& {
        return elasticity.drying_shrinkage;
      },
      "K_DESSIC"}}};

bool ignores(const solver::StaticProblem& problem, int cell, const StrainingVariable& variable) {
  const solver::Elasticity* elasticity = has_mass(*problem.model, cell) ? elasticity_of(problem, cell) : nullptr;
  const auto* isotropic = elasticity != nullptr ? std::get_if<solver::IsotropicElasticity>(elasticity) : nullptr;
  if (isotropic == nullptr || !is_missing(variable.coefficient(*isotropic))) return false;
  const solver::Relation relation = problem.behaviours && !problem.behaviours->empty()
                                        ? (*problem.behaviours)[static_cast<std::size_t>(cell)].relation
                                        : solver::Relation::elastic;
  return solver::is_constant(*isotropic, problem.materials->by_cell[static_cast<std::size_t>(cell)]->plasticity,
                             relation);
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
      context.diagnostics.alarm(
          "no-expansion",
          fmt::format(
              "{}: {} is given on {}, whose material has no {} and nothing that depends on it: no strain comes of it",
              call.command, variable.name, problem.model->mesh->cell_name(*first), variable.keyword),
          call.span, fmt::format("give {} in DEFI_MATERIAU (ELAS)", variable.keyword));
      break;
    }
  }
}

void warn_of_missing_data(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.materials) return;
  warn_of_missing_density(call, problem, context);
  warn_of_missing_expansion(call, problem, context);
}

/// The first that is not zero.
double strain_of_bars(const solver::StaticProblem& problem, const solver::FieldInput& input) {
  for (int cell = 0; cell < problem.model->mesh->cell_count(); ++cell) {
    if (!solver::is_bar(problem.model->formulations[static_cast<std::size_t>(cell)])) continue;
    const solver::Elasticity* elasticity = elasticity_of(problem, cell);
    const auto* isotropic = elasticity != nullptr ? std::get_if<solver::IsotropicElasticity>(elasticity) : nullptr;
    if (isotropic == nullptr) continue;
    const double strain = solver::inelastic_axial_strain(*isotropic, solver::middle_point(input, cell));
    if (strain != 0.0) return strain;
  }
  return 0.0;
}

void warn_of_strained_start(const interpreter::Call& call, const solver::StaticProblem& problem, double instant,
                            Context& context) {
  if (problem.initial || !problem.materials || problem.materials->variables.empty()) return;
  const solver::VariableState state(*problem.model->mesh, problem.materials->variables, instant);
  const solver::FieldInput input{*problem.model, *problem.materials, *problem.properties, state};
  constexpr double rounding = 1e-12;
  const auto first_strain = [](const solver::ElementField& field, std::string_view prefix) {
    const std::size_t width = field.components.size();
    for (std::size_t k = 0; k < field.values.size(); ++k)
      if (field.components[k % width].starts_with(prefix) && std::abs(field.values[k]) > rounding)
        return field.values[k];
    return 0.0;
  };
  double strain = first_strain(solver::variable_strain_field(input), "EP");
  if (strain == 0.0) strain = first_strain(solver::command_variable_field(input), "EPSA");
  if (strain == 0.0) strain = strain_of_bars(problem, input);
  if (strain == 0.0) return;
  context.diagnostics.alarm(
      "strained-start",
      fmt::format("{}: at the first instant, {:.6g}, command variables differ from their reference values (strain "
                  "{:.3g}): elasticity without a memory takes the whole strain, "
                  "laws with a memory and large strains what changes from there",
                  call.command, instant, strain),
      call.span, "begin at an instant where the variables have their reference values (VALE_REF)");
}

void warn_of_initial_strains(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  const auto gives_strains = [](const solver::AppliedLoad& each) { return solver::gives_initial_strains(*each.load); };
  if (!has_flow(problem) || std::ranges::none_of(problem.loads, gives_strains)) return;
  context.diagnostics.alarm("initial-strains",
                            fmt::format("{}: laws that flow see strains less the initial ones (PRE_EPSI); what "
                                        "Code_Aster does beyond the yield point is not known",
                                        call.command),
                            call.span,
                            "give strains that are known beforehand as a command variable (AFFE_VARC, EPSA)");
}

// A result may have been kept without some of its fields (ARCHIVAGE, CHAM_EXCLU).
void warn_of_missing_state(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.initial || !call.factor("ETAT_INIT").has("EVOL_NOLI")) return;
  const interpreter::Keywords& given = call.factor("ETAT_INIT");
  const auto is_computed = [](const solver::ResultStep& step) { return step.parameters.contains("ITER_GLOB"); };
  if (std::ranges::none_of(given.data<ResultConcept>("EVOL_NOLI").result.steps, is_computed))
    return;  // CREA_RESU makes what is meant
  const auto warn = [&](const char* field, const char* what, const char* keyword) {
    context.diagnostics.alarm(
        "no-initial-field",
        fmt::format("{}: the step of {} that it starts from holds no {}: {} begin at zero", call.command,
                    given.concept_of("EVOL_NOLI")->name, field, what),
        given.span_of("EVOL_NOLI"),
        fmt::format("keep {} in the result (ARCHIVAGE, CHAM_EXCLU), or give the field by {}", field, keyword));
  };
  if (!problem.initial->displacement) warn("DEPL", "displacements", "DEPL");
  if (!problem.initial->stresses) warn("SIEF_ELGA", "stresses", "SIGM");
}

// Where the initial displacement says nothing of a node it counts as zero.
void warn_of_partial_displacement(const interpreter::Call& call, const solver::StaticProblem& problem,
                                  Context& context) {
  if (!problem.initial || !problem.initial->displacement) return;
  const solver::NodalField& displacement = *problem.initial->displacement;
  const solver::DofMap dofs(*problem.model);
  int count = 0, first = -1;
  for (int dof = 0; dof < dofs.size(); ++dof) {
    if (static_cast<int>(dofs.component_of(dof)) >= solver::motion_count) continue;
    const int column = displacement.component(solver::name_of(dofs.component_of(dof)));
    if (column >= 0 && !std::isnan(displacement.at(dofs.node_of(dof), column))) continue;
    if (count++ == 0) first = dof;
  }
  if (count == 0) return;
  const interpreter::Keywords& given = call.factor("ETAT_INIT");
  context.diagnostics.alarm(
      "partial-state",
      fmt::format("{}: the displacement that it starts from says nothing of {} component{} of nodes, {} at {} the "
                  "first: they begin at zero",
                  call.command, count, count == 1 ? "" : "s", solver::name_of(dofs.component_of(first)),
                  problem.model->mesh->node_name(dofs.node_of(first))),
      given.span_of(given.has("DEPL") ? "DEPL" : "EVOL_NOLI"), "give a field of all nodes and components of the model");
}

// What flowed in the step before is not kept in results.
void warn_of_forgotten_flow(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.initial || call.text("METHODE") != "IMPLEX" || !has_flow(problem)) return;
  context.diagnostics.alarm(
      "forgotten-flow",
      fmt::format("{}: METHODE='IMPLEX' does not know what flowed before ETAT_INIT: its first step is elastic",
                  call.command),
      call.factor("ETAT_INIT").span, "begin with a short step, or go on without ETAT_INIT");
}

void warn_of_lost_variables(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.initial || !problem.initial->displacement || problem.initial->variables || !has_flow(problem)) return;
  context.diagnostics.alarm(
      "no-internal-variables",
      fmt::format(
          "{}: ETAT_INIT gives displacements without internal variables: hardening and plastic strains begin at zero",
          call.command),
      call.factor("ETAT_INIT").span, "give VARI too, or keep VARI_ELGA in the result (ARCHIVAGE, CHAM_EXCLU)");
}

void warn_of_released_points(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.contact || !problem.initial || !problem.initial->displacement ||
      call.factor("ETAT_INIT").has("EVOL_NOLI"))
    return;
  if (std::ranges::none_of(problem.contact->zones,
                           [](const solver::ContactZone& zone) { return zone.mixed.bilateral; }))
    return;
  context.diagnostics.alarm("released-points",
                            fmt::format("{}: ETAT_INIT gives fields, which do not say what points GLISSIERE holds: of "
                                        "those that touch, rounding decides",
                                        call.command),
                            call.factor("ETAT_INIT").span, "give the result and its step (EVOL_NOLI)");
}

/// Whether it has warned.
bool warn_of_other_laws(const interpreter::Call& call, const solver::BehaviourOfCells* before,
                        const solver::StaticProblem& problem, Context& context) {
  if (before == nullptr || !problem.behaviours || !problem.initial || !problem.initial->variables) return false;
  const solver::BehaviourOfCells& now = *problem.behaviours;
  const std::vector<std::string> none = {"VIDE"};
  for (std::size_t cell = 0; cell < std::min(before->size(), now.size()); ++cell) {
    if ((*before)[cell] == now[cell]) continue;
    const auto had = solver::variable_names((*before)[cell]), has = solver::variable_names(now[cell]);
    if (had == none || has == none) continue;
    // Some laws have variables without names.
    const bool is_named = !had.empty() && !has.empty();
    if (is_named ? had == has : (*before)[cell].relation == now[cell].relation) continue;
    context.diagnostics.alarm(
        "other-variables",
        fmt::format(
            "{}: the law of cell {} had the internal variables {} and now has {}: they are taken by their numbers",
            call.command, problem.model->mesh->cell_name(static_cast<int>(cell)),
            had.empty() ? "of its own" : fmt::format("{}", fmt::join(had, ", ")),
            has.empty() ? "others" : fmt::format("{}", fmt::join(has, ", "))),
        call.factor("ETAT_INIT").span, "go on with the same law, or give VARI that belong to the new one");
    return true;
  }
  return false;
}

// Fields of another law, or brought from nodes to points, may hold what no law leaves behind.
void warn_of_odd_variables(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.initial || !problem.initial->variables || !problem.behaviours || problem.behaviours->empty()) return;
  const solver::ElementField& variables = *problem.initial->variables;
  const interpreter::Keywords& given = call.factor("ETAT_INIT");
  const auto warn = [&](int cell, const std::string& what, const char* effect, const char* hint) {
    context.diagnostics.alarm("odd-variables",
                              fmt::format("{}: the initial state has {} in cell {}: {}", call.command, what,
                                          problem.model->mesh->cell_name(cell), effect),
                              given.span_of(given.has("VARI") ? "VARI" : "EVOL_NOLI"), hint);
  };
  constexpr double rounding = 1e-12;
  const int width = static_cast<int>(variables.components.size());
  for (int cell = 0; cell < problem.model->mesh->cell_count(); ++cell) {
    const solver::CellBehaviour& law = (*problem.behaviours)[static_cast<std::size_t>(cell)];
    const auto names = solver::variable_names(law);
    // The multiplicative split has more of them than names.
    const int known = law.kinematics == solver::Kinematics::multiplicative ? width : static_cast<int>(names.size());
    if (names.empty() || names.front() == "VIDE" || problem.model->components_of(cell) == 0) continue;
    for (int point = 0; point < variables.points(cell); ++point) {
      for (int k = known; k < width; ++k) {
        if (!(std::abs(variables.at(cell, point, k)) > 0.0)) continue;
        return warn(
            cell,
            fmt::format("{} = {:.6g}", variables.components[static_cast<std::size_t>(k)], variables.at(cell, point, k)),
            fmt::format("its law has {} internal variables, and what is beyond them counts for nothing", known).c_str(),
            "give the internal variables of the law of COMPORTEMENT");
      }
      const int strain = names.front() == "EPSPEQ" ? variables.component("V1") : -1;
      if (strain < 0 || !(variables.at(cell, point, strain) < -rounding)) continue;
      return warn(
          cell, fmt::format("a cumulated plastic strain of {:.6g}", variables.at(cell, point, strain)),
          "it cannot be below zero",
          "give VARI_ELGA as it was computed: what was brought to nodes (VARI_ELNO) or interpolated overshoots");
    }
  }
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
  context.diagnostics.alarm(
      "no-behaviour",
      fmt::format(
          "{}: COMPORTEMENT leaves out {} cell{}, {} the first: what it leaves out is elastic, in small strains",
          call.command, count, count == 1 ? "" : "s", model.mesh->cell_name(first)),
      call.factors("COMPORTEMENT").front().span, "name all cells that carry stiffness, those with RELATION='ELAS' too");
}

bool has_other_elements(const solver::Model* own, const solver::Model& model) {
  return own != nullptr && own != &model && own->formulations != model.formulations;
}

// What is given for a model is taken by the numbers of its cells and nodes.
void warn_of_other_models(const interpreter::Call& call, const solver::Model& model, Context& context) {
  const auto look_at = [&](const interpreter::Keywords& keywords, const char* keyword, const solver::Model* own) {
    if (!has_other_elements(own, model)) return;
    context.diagnostics.alarm("other-model",
                              fmt::format("{}: {} was made on a model that has other elements than MODELE: what it "
                                          "says of cells and nodes is taken as if it were said of these",
                                          call.command, keywords.concept_of(keyword)->name),
                              keywords.span_of(keyword), "make it on the model that is computed");
  };
  if (call.has("EXCIT"))
    for (const interpreter::Keywords& excitation : call.factors("EXCIT"))
      look_at(excitation, "CHARGE", excitation.data<LoadConcept>("CHARGE").model.get());
  if (call.has("CARA_ELEM")) look_at(call, "CARA_ELEM", call.data<PropertiesConcept>("CARA_ELEM").model.get());
  if (call.has("CONTACT")) look_at(call, "CONTACT", call.data<ContactConcept>("CONTACT").model.get());
}

}  // namespace

void warn_of_scene(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  warn_of_locking(call, problem, context);
  warn_of_missing_data(call, problem, context);
  warn_of_repeated_loads(call, context);
  warn_of_other_models(call, *problem.model, context);
}

void warn_of_missing_masses(const interpreter::Call& call, const solver::StaticProblem& problem,
                            const std::set<int>& cells, Context& context) {
  std::set<int> weightless;
  std::ranges::copy_if(cells, std::inserter(weightless, weightless.end()),
                       [&](int cell) { return lacks_density(problem, cell); });
  warn_of_no_density(call, problem, weightless, "MASS_INER counts", "they add no mass", context);
}

void warn_of_loads_at_the_start(const interpreter::Call& call, const solver::StaticProblem& problem, double instant,
                                Context& context) {
  if (call.given("INST") || call.given("LIST_INST") || !problem.materials->variables.empty()) return;
  const auto vanishes = [&](const solver::AppliedLoad& each) {
    return solver::only_holds(*each.load) || (each.multiplier && each.multiplier(instant) == 0.0);
  };
  if (!std::ranges::all_of(problem.loads, vanishes)) return;
  for (const interpreter::Keywords& excitation : call.factors("EXCIT")) {
    if (!excitation.has("FONC_MULT") || solver::only_holds(*excitation.data<LoadConcept>("CHARGE").load.get()))
      continue;
    context.diagnostics.alarm(
        "no-load",
        fmt::format("{}: all loads vanish at INST={}, which is computed where no instant is given: nothing moves",
                    call.command, instant),
        excitation.span_of("FONC_MULT"), "give INST or LIST_INST, or leave FONC_MULT out");
    return;
  }
}

void warn_of_nonlinear_scene(const interpreter::Call& call, const solver::StaticProblem& problem, double first_instant,
                             const solver::BehaviourOfCells* before, Context& context) {
  warn_of_scene(call, problem, context);
  warn_of_strained_start(call, problem, first_instant, context);
  warn_of_cells_without_behaviour(call, *problem.model, context);
  warn_of_initial_strains(call, problem, context);
  warn_of_missing_state(call, problem, context);
  warn_of_partial_displacement(call, problem, context);
  warn_of_forgotten_flow(call, problem, context);
  warn_of_lost_variables(call, problem, context);
  warn_of_released_points(call, problem, context);
  if (!warn_of_other_laws(call, before, problem, context)) warn_of_odd_variables(call, problem, context);
}

}  // namespace comma::commands
