#include "commands/alarms/start_alarms.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/concepts.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/elements/plates/plate_axes.hpp"
#include "solver/elements/slender/slender_member.hpp"
#include "solver/error.hpp"
#include "solver/fields/points/variable_fields.hpp"
#include "solver/fields/points/variable_names.hpp"

namespace comma::commands {

namespace {

bool has_flow(const solver::StaticProblem& problem) {
  return problem.behaviours && std::ranges::any_of(*problem.behaviours, [](const solver::CellBehaviour& each) {
           return each.relation != solver::Relation::elastic && each.relation != solver::Relation::hyperelastic;
         });
}

/// Null where a cell has no isotropic elasticity.
const solver::IsotropicElasticity* isotropic_of(const solver::StaticProblem& problem, int cell) {
  const auto& material = problem.materials->by_cell[static_cast<std::size_t>(cell)];
  return material && material->elasticity ? std::get_if<solver::IsotropicElasticity>(&*material->elasticity) : nullptr;
}

/// The first that is not zero.
double strain_of_bars(const solver::StaticProblem& problem, const solver::FieldInput& input) {
  for (int cell = 0; cell < problem.model->mesh->cell_count(); ++cell) {
    if (!solver::is_bar(problem.model->formulations[static_cast<std::size_t>(cell)])) continue;
    const auto* isotropic = isotropic_of(problem, cell);
    if (isotropic == nullptr) continue;
    const double strain =
        solver::inelastic_axial_strain(*isotropic, solver::middle_of(*input.model.mesh, cell, input.state));
    if (strain != 0.0) return strain;
  }
  return 0.0;
}

/// Whether the pressure is the bulk modulus times the whole change of volume, whatever the law.
bool has_elastic_volume(solver::Formulation formulation) { return solver::mixed_field_count(formulation) == 1; }

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
  const bool has_whole_volumes = std::ranges::any_of(problem.model->formulations, has_elastic_volume);
  context.diagnostics.alarm(
      "strained-start",
      fmt::format(
          "{}: at the first instant, {:.6g}, command variables differ from their reference values (strain "
          "{:.3g}): elasticity takes the whole strain but in GREEN_LAGRANGE and PETIT_REAC, and so do ELAS_VMIS, "
          "VMIS_ISOT_NL and SIMO_MIEHE; bars, beams and other laws take what changes from there{}",
          call.command, instant, strain,
          has_whole_volumes ? ", but for the volume of INCO_UP cells, which has the whole whatever the law" : ""),
      call.span, "begin at an instant where the variables have their reference values (VALE_REF)");
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
  if (!problem.initial->stresses)
    warn("SIEF_ELGA", "stresses, but for those of solids with ELAS (PETIT, GDEF_LOG) or VMIS_ISOT_NL,", "SIGM");
}

/// How a cell takes pressures and command variables, in the middle of it.
struct ElasticVolume {
  double bulk = 0.0;
  double strain = 0.0;  ///< of the command variables
};

std::optional<ElasticVolume> elastic_volume(const solver::StaticProblem& problem, const solver::FieldInput& input,
                                            int cell) {
  const auto* isotropic = isotropic_of(problem, cell);
  if (isotropic == nullptr) return std::nullopt;
  const solver::MaterialPoint at = solver::middle_of(*input.model.mesh, cell, input.state);
  const solver::IsotropicModuli moduli = solver::moduli(*isotropic, at);
  return ElasticVolume{moduli.young / (3.0 * (1.0 - 2.0 * moduli.poisson)),
                       3.0 * solver::inelastic_axial_strain(*isotropic, at)};
}

// Other elements keep their stresses, and have the new elasticity for what changes from there.
void warn_of_other_volumes(const interpreter::Call& call, const solver::StaticProblem& problem, double instant,
                           Context& context) try {
  if (!problem.initial || !problem.materials || !call.factor("ETAT_INIT").has("EVOL_NOLI")) return;
  const interpreter::Keywords& given = call.factor("ETAT_INIT");
  const solver::StaticProblem& before = given.data<ResultConcept>("EVOL_NOLI").problem;
  if (!before.materials || before.materials == problem.materials || !before.model ||
      before.model->mesh != problem.model->mesh ||
      std::ranges::none_of(problem.model->formulations, has_elastic_volume))
    return;
  const solver::Mesh& mesh = *problem.model->mesh;
  const solver::VariableState state(mesh, problem.materials->variables, instant),
      state_before(mesh, before.materials->variables, instant);
  const solver::FieldInput input{*problem.model, *problem.materials, *problem.properties, state},
      input_before{*problem.model, *before.materials, *problem.properties, state_before};
  const auto differ = [](double a, double b) {
    constexpr double same = 1e-6;
    return std::abs(a - b) > same * std::max(std::abs(a), std::abs(b));
  };
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (!has_elastic_volume(problem.model->formulations[static_cast<std::size_t>(cell)]) ||
        problem.model->is_skin(cell))
      continue;
    const auto old = elastic_volume(before, input_before, cell), now = elastic_volume(problem, input, cell);
    if (!old || !now) continue;
    std::vector<std::string> others;
    if (differ(old->bulk, now->bulk))
      others.push_back(fmt::format("a bulk modulus of {:.6g} after {:.6g}", now->bulk, old->bulk));
    if (differ(old->strain, now->strain))
      others.push_back(
          fmt::format("a change of volume by command variables of {:.3g} after {:.3g}", now->strain, old->strain));
    if (others.empty()) continue;
    context.diagnostics.alarm(
        "other-volume",
        fmt::format(
            "{}: cell {} goes on with {}: with INCO_UP pressures follow from the whole change of volume by the "
            "elasticity of now, so that what was reached before moves, where other elements keep their stresses",
            call.command, mesh.cell_name(cell), fmt::join(others, " and ")),
        given.span_of("EVOL_NOLI"), "take INCO_UPG, which keeps the stresses, or go on with the same elasticity");
    return;
  }
} catch (const solver::Error&) {
  // What was there before need not be known at this instant: it does not go into what is computed.
}

/// By which stresses and forces of the cell are to be read otherwise than before; empty: by nothing.
std::vector<const char*> changes_of_frame(const solver::Mesh& mesh, int cell, const solver::ElementProperties& before,
                                          const solver::ElementProperties& now) {
  constexpr double rounding = 1e-9;
  const auto differ = [](const auto& a, const auto& b) { return (a - b).norm() > rounding; };
  std::vector<const char*> result;
  const auto in_both = [cell](const auto& one, const auto& other) {
    return one.contains(cell) && other.contains(cell) ? std::optional(std::pair(one.at(cell), other.at(cell)))
                                                      : std::nullopt;
  };
  if (const auto plates = in_both(before.plates, now.plates)) {
    const auto& [old, own] = *plates;
    if (differ(solver::plate_axes(mesh, cell, old), solver::plate_axes(mesh, cell, own)))
      result.push_back("other own axes");
    if (std::abs(old.thickness - own.thickness) > rounding * own.thickness) result.push_back("another thickness");
    if (std::abs(old.offset - own.offset) > rounding * own.thickness) result.push_back("another offset");
  }
  if (const auto beams = in_both(before.sections, now.sections))
    if (std::abs(beams->first.roll - beams->second.roll) > rounding) result.push_back("other own axes");
  if (const auto springs = in_both(before.discrete, now.discrete))
    if (differ(springs->first.axes, springs->second.axes)) result.push_back("other own axes");
  return result;
}

// Stresses of plates, and forces of beams and springs, are components in own axes.
void warn_of_other_frames(const interpreter::Call& call, const solver::StaticProblem& problem, Context& context) {
  if (!problem.initial || !problem.initial->stresses || !call.factor("ETAT_INIT").has("EVOL_NOLI")) return;
  const interpreter::Keywords& given = call.factor("ETAT_INIT");
  const solver::StaticProblem& before = given.data<ResultConcept>("EVOL_NOLI").problem;
  if (!before.properties || before.properties == problem.properties || !before.model ||
      before.model->mesh != problem.model->mesh)
    return;
  const solver::Mesh& mesh = *problem.model->mesh;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto changes = changes_of_frame(mesh, cell, *before.properties, *problem.properties);
    if (changes.empty()) continue;
    context.diagnostics.alarm(
        "other-frame",
        fmt::format("{}: cell {} goes on with {}: the stresses and forces of the state that it starts from are "
                    "taken for those of now, and need not balance the loads",
                    call.command, mesh.cell_name(cell), fmt::join(changes, " and ")),
        given.span_of("EVOL_NOLI"), "go on with the axes, thickness and offset of before");
    return;
  }
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

/// A law cannot go on from the internal variables of one that has others.
void require_same_variables(const interpreter::Call& call, const solver::BehaviourOfCells* before,
                            const solver::StaticProblem& problem) {
  if (before == nullptr || !problem.behaviours || !problem.initial || !problem.initial->variables) return;
  const solver::BehaviourOfCells& now = *problem.behaviours;
  const std::vector<std::string> none = {"VIDE"};
  for (std::size_t cell = 0; cell < std::min(before->size(), now.size()); ++cell) {
    if ((*before)[cell] == now[cell]) continue;
    const auto had = solver::variable_names((*before)[cell]), has = solver::variable_names(now[cell]);
    if (had == none || has == none) continue;
    // Some laws have variables without names.
    const bool is_named = !had.empty() && !has.empty();
    if (is_named ? had == has : (*before)[cell].relation == now[cell].relation) continue;
    throw interpreter::DiagnosticError(
        "other-variables",
        fmt::format("{}: the law of cell {} had the internal variables {} and now has {}, and cannot go on from them",
                    call.command, problem.model->mesh->cell_name(static_cast<int>(cell)),
                    had.empty() ? "of its own" : fmt::format("{}", fmt::join(had, ", ")),
                    has.empty() ? "others" : fmt::format("{}", fmt::join(has, ", "))),
        call.factor("ETAT_INIT").span,
        "go on with the same law, or give fields (ETAT_INIT=_F(DEPL=..., SIGM=..., VARI=...)) that belong to the new "
        "one");
  }
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
    // In plane stress VMIS_ISOT_NL keeps the strain across the plane, which has no name here.
    const int unnamed = law.relation == solver::Relation::isotropic_nonlinear ? 1 : 0;
    const int known = static_cast<int>(names.size()) + unnamed;
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

}  // namespace

void warn_of_start(const interpreter::Call& call, const solver::StaticProblem& problem, double instant,
                   const solver::BehaviourOfCells* before, Context& context) {
  warn_of_strained_start(call, problem, instant, context);
  warn_of_missing_state(call, problem, context);
  warn_of_partial_displacement(call, problem, context);
  warn_of_other_volumes(call, problem, instant, context);
  warn_of_other_frames(call, problem, context);
  warn_of_forgotten_flow(call, problem, context);
  warn_of_lost_variables(call, problem, context);
  warn_of_released_points(call, problem, context);
  require_same_variables(call, before, problem);
  warn_of_odd_variables(call, problem, context);
}

}  // namespace comma::commands
