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

#include "commands/alarms/start_alarms.hpp"
#include "commands/analysis/behaviour_reading.hpp"
#include "commands/concepts.hpp"
#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/elements/solids/imposed_strains.hpp"
#include "solver/elements/solids/locking.hpp"
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
  const solver::CellBehaviour behaviour = problem.behaviours && !problem.behaviours->empty()
                                              ? (*problem.behaviours)[static_cast<std::size_t>(cell)]
                                              : solver::CellBehaviour();
  return !behaviour.restores_hardening &&
         solver::is_constant(*isotropic, problem.materials->by_cell[static_cast<std::size_t>(cell)]->plasticity,
                             behaviour.relation);
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

// They keep their directions, where beams beside them turn.
void warn_of_small_bars(const interpreter::Call& call, const solver::Model& model, Context& context) {
  for (const interpreter::Keywords& keywords : call.factors("COMPORTEMENT")) {
    if (keywords.text("DEFORMATION") != "GROT_GDEP") continue;
    const std::vector<int> cells = cells_of_behaviour(keywords, *model.mesh);
    const auto bar = std::ranges::find_if(
        cells, [&](int cell) { return solver::is_bar(model.formulations[static_cast<std::size_t>(cell)]); });
    if (bar == cells.end()) continue;
    context.diagnostics.alarm(
        "small-bars",
        fmt::format("{}: DEFORMATION='GROT_GDEP' leaves bars, {} the first, in small displacements, as Code_Aster does",
                    call.command, model.mesh->cell_name(*bar)),
        keywords.span_of("DEFORMATION"), "give bars that turn DEFORMATION='PETIT_REAC', or POU_D_T for BARRE");
  }
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
  warn_of_cells_without_behaviour(call, *problem.model, context);
  warn_of_small_bars(call, *problem.model, context);
  warn_of_start(call, problem, first_instant, before, context);
}

}  // namespace comma::commands
