#include "commands/analysis/initial_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands/analysis/result_reading.hpp"
#include "commands/analysis/same_mesh.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/points/discretisation.hpp"
#include "solver/fields/stresses/beam_forces.hpp"

namespace comma::commands {

namespace {

using interpreter::DiagnosticError;
using interpreter::Keywords;

template <class Field>
void take_field(const Keywords& keywords, const char* keyword, const char* kind, std::optional<Field>& target) {
  if (!keywords.has(keyword)) return;
  const auto* field = std::get_if<Field>(&keywords.data<FieldConcept>(keyword).field);
  if (field == nullptr) {
    throw DiagnosticError("wrong-type", std::string("ETAT_INIT/") + keyword + " must be a field " + kind,
                          keywords.span_of(keyword));
  }
  target = *field;
}

template <class Field>
void take_held(const solver::ResultStep& step, const char* name, std::optional<Field>& target) {
  const auto found = step.fields.find(name);
  if (found == step.fields.end()) return;
  if (const auto* field = std::get_if<Field>(&found->second)) target = *field;
}

const solver::ResultStep& step_of(const Keywords& keywords) {
  const solver::Result& result = keywords.data<ResultConcept>("EVOL_NOLI").result;
  if (keywords.has("NUME_ORDRE") || keywords.has("INST"))
    return only_step(keywords, result, "a computation starts from one");
  if (result.steps.empty())
    throw DiagnosticError("unknown-step", "ETAT_INIT: the result holds no step to start from",
                          keywords.span_of("EVOL_NOLI"));
  return result.steps.back();
}

const solver::ResultStep& step_of_order(const Keywords& keywords, const char* keyword) {
  const auto& steps = keywords.data<ResultConcept>("EVOL_NOLI").result.steps;
  const auto found = std::ranges::find_if(
      steps, [&](const solver::ResultStep& step) { return step.order == keywords.integer(keyword); });
  if (found != steps.end()) return *found;
  throw DiagnosticError(
      "unknown-step",
      fmt::format("ETAT_INIT: {} has no step number {}", keywords.concept_of("EVOL_NOLI")->name,
                  keywords.integer(keyword)),
      keywords.span_of(keyword),
      steps.empty() ? "" : fmt::format("it has those from {} to {}", steps.front().order, steps.back().order));
}

// What a path that goes on from there needs to know of it.
void take_path(const solver::Result& result, const solver::ResultStep& step, solver::InitialState& state) {
  if (const auto intensity = step.parameters.find("ETA_PILOTAGE"); intensity != step.parameters.end())
    state.intensity = intensity->second;
  if (&step != &result.steps.front()) take_held(*(&step - 1), "DEPL", state.earlier);
}

bool has_surfaces_of(const solver::ContactDefinition& a, const solver::ContactDefinition& b) {
  return a.formulation == b.formulation && a.has_friction == b.has_friction &&
         std::ranges::equal(a.zones, b.zones, [](const solver::ContactZone& one, const solver::ContactZone& other) {
           return one.master_cells == other.master_cells && one.slave_cells == other.slave_cells;
         });
}

// Of contact between the same surfaces the step says how it is.
void take_contact_fields(const interpreter::Call& call, const solver::StaticProblem& before,
                         const solver::ResultStep& step, solver::InitialState& state) {
  if (!before.contact || !call.has("CONTACT")) return;
  const auto* now = std::get_if<solver::ContactDefinition>(&call.data<ContactConcept>("CONTACT").conditions);
  if (now == nullptr || !has_surfaces_of(*before.contact, *now)) return;
  for (const char* name : {"CONT_NOEU", "CONT_ELEM"})
    if (const auto held = step.fields.find(name); held != step.fields.end())
      state.contact_fields.emplace(name, held->second);
}

// Stresses and variables live at Gauss points.
void bring_to_points(const interpreter::Call& call, std::optional<solver::ElementField>& field) {
  if (!field || field->support == solver::Support::gauss_point) return;
  field = solver::brought_to(*call.data<ModelConcept>("MODELE").model, *field, solver::Support::gauss_point, false);
}

// What has acted so far. Forces may have no place on another model, which has lost cells, say: of those only what
// strains its cells counts there.
std::vector<solver::AppliedLoad> loads_so_far(const solver::StaticProblem& before, const solver::Model& now) {
  if (before.model.get() == &now) return before.loads;
  std::vector<solver::AppliedLoad> loads = before.loads;
  for (solver::AppliedLoad& applied : loads) {
    auto strains = std::make_shared<solver::Load>();
    strains->initial_strains = applied.load->initial_strains;
    strains->initial_slender_strains = applied.load->initial_slender_strains;
    strains->initial_plate_strains = applied.load->initial_plate_strains;
    strains->initial_strain_fields = applied.load->initial_strain_fields;
    applied.load = std::move(strains);
  }
  return loads;
}

void require_same_mesh(const Keywords& keywords, const solver::Mesh& mesh) {
  if (keywords.has("EVOL_NOLI"))
    require_mesh(keywords, "EVOL_NOLI", &keywords.data<ResultConcept>("EVOL_NOLI").result.mesh(), mesh);
  for (const char* field : {"DEPL", "SIGM", "VARI"})
    if (keywords.has(field)) require_mesh(keywords, field, keywords.data<FieldConcept>(field).mesh.get(), mesh);
}

}  // namespace

InitialStateChoice initial_state(const interpreter::Call& call) {
  InitialStateChoice choice;
  if (!call.has("ETAT_INIT")) return choice;
  const Keywords& keywords = call.factor("ETAT_INIT");
  require_same_mesh(keywords, *call.data<ModelConcept>("MODELE").model->mesh);
  auto state = std::make_shared<solver::InitialState>();
  if (keywords.has("EVOL_NOLI")) {
    const solver::ResultStep& step = step_of(keywords);
    take_held(step, "DEPL", state->displacement);
    take_held(step, "SIEF_ELGA", state->stresses);
    take_held(step, "VARI_ELGA", state->variables);
    const solver::StaticProblem& problem = keywords.data<ResultConcept>("EVOL_NOLI").problem_of(step);
    state->loads = loads_so_far(problem, *call.data<ModelConcept>("MODELE").model);
    choice.behaviours = problem.behaviours;
    take_path(keywords.data<ResultConcept>("EVOL_NOLI").result, step, *state);
    state->contact = step.contact;
    take_contact_fields(call, problem, step, *state);
    choice.instant = step.instant;
    choice.order = step.order;
  }
  if (keywords.has("NUME_DIDI")) take_held(step_of_order(keywords, "NUME_DIDI"), "DEPL", state->differential_reference);
  take_field(keywords, "DEPL", "at nodes", state->displacement);
  take_field(keywords, "SIGM", "on cells", state->stresses);
  take_field(keywords, "VARI", "on cells", state->variables);
  bring_to_points(call, state->stresses);
  bring_to_points(call, state->variables);
  if (keywords.has("INST_ETAT_INIT")) choice.instant = keywords.real("INST_ETAT_INIT");
  choice.state = std::move(state);
  return choice;
}

void check_initial_stresses(const interpreter::Call& call, const solver::StaticProblem& problem) {
  if (!call.has("ETAT_INIT") || !problem.behaviours || !problem.initial || !problem.initial->stresses) return;
  const Keywords& keywords = call.factor("ETAT_INIT");
  const solver::ElementField& stresses = *problem.initial->stresses;
  // Elasticity leaves one that is empty behind (VIDE).
  const bool has_variables = problem.initial->variables && problem.initial->variables->components.size() > 1;
  for (int cell = 0; cell < problem.model->mesh->cell_count(); ++cell) {
    const solver::CellBehaviour& law = (*problem.behaviours)[static_cast<std::size_t>(cell)];
    const bool by_displacement = law.relation == solver::Relation::hyperelastic && !problem.initial->displacement;
    const bool by_variables = law.kinematics == solver::Kinematics::multiplicative && !has_variables;
    if (!by_displacement && !by_variables) continue;
    if (!solver::has_other_than_zero(stresses, cell)) continue;
    throw DiagnosticError(
        "unsupported",
        fmt::format("ETAT_INIT: cell {} does not start from stresses: those of {} follow from the {}",
                    problem.model->mesh->cell_name(cell), by_displacement ? "ELAS_HYPER" : "SIMO_MIEHE",
                    by_displacement ? "displacement" : "internal variables"),
        keywords.has("SIGM") ? keywords.span_of("SIGM") : keywords.span,
        by_displacement ? "give DEPL, or another RELATION"
                        : "give VARI too (a result that has VARI_ELGA of that law), or take DEFORMATION='GDEF_LOG'");
  }
}

void complete_variables(solver::StaticProblem& problem, const solver::BehaviourOfCells* before) {
  if (before == nullptr || !problem.behaviours || !problem.initial || !problem.initial->variables) return;
  const auto is_small = [](const solver::CellBehaviour& law) {
    return law.kinematics == solver::Kinematics::small || law.kinematics == solver::Kinematics::green_lagrange;
  };
  const auto is_absent = [](double value) { return std::isnan(value); };
  const solver::ElementField& given = *problem.initial->variables;
  std::vector<int> lacking;
  for (std::size_t cell = 0; cell < std::min(before->size(), problem.behaviours->size()); ++cell)
    if ((*before)[cell].relation == solver::Relation::elastic && is_small((*before)[cell]) &&
        is_small((*problem.behaviours)[cell]) &&
        std::ranges::any_of(solver::values_of_cell(given, static_cast<int>(cell)), is_absent))
      lacking.push_back(static_cast<int>(cell));
  if (lacking.empty()) return;
  auto state = std::make_shared<solver::InitialState>(*problem.initial);
  const auto width = static_cast<std::ptrdiff_t>(given.components.size());
  for (const int cell : lacking)
    std::replace_if(state->variables->values.begin() + given.starts[cell] * width,
                    state->variables->values.begin() + given.starts[cell + 1] * width, is_absent, 0.0);
  problem.initial = std::move(state);
}

void check_turned_beams(const interpreter::Call& call, const solver::StaticProblem& problem,
                        const solver::BehaviourOfCells* before) {
  if (!problem.initial || !problem.initial->displacement || !problem.initial->stresses) return;
  const Keywords& keywords = call.factor("ETAT_INIT");
  if (keywords.has("SIGM")) {
    const auto& own = keywords.data<FieldConcept>("SIGM").behaviours;
    if (own) before = own.get();
  }
  const auto cell_count = static_cast<std::size_t>(problem.model->mesh->cell_count());
  if (before == nullptr || before->size() != cell_count) return;
  // Forces that turn by a thousandth are what small displacements leave out in any case.
  constexpr double small_turn = 1e-3;
  const auto& variables = problem.initial->variables;
  const auto axes =
      solver::turned_axes(*problem.model, *before, *problem.initial->displacement, variables ? &*variables : nullptr);
  for (const auto& [cell, now] : axes) {
    const bool turns_on =
        problem.behaviours && !problem.behaviours->empty() &&
        (*problem.behaviours)[static_cast<std::size_t>(cell)].kinematics == solver::Kinematics::large_rotations;
    const auto section = problem.properties->sections.find(cell);
    if (turns_on || section == problem.properties->sections.end()) continue;
    const auto first = solver::own_axes(*problem.model->mesh, cell, section->second.roll);
    const Eigen::Matrix3d turn = now - first;
    if (!(turn.topRows(variables ? 3 : 1).cwiseAbs().maxCoeff() > small_turn)) continue;
    throw DiagnosticError(
        "unsupported",
        fmt::format(
            "ETAT_INIT: beam {} was turned by DEFORMATION='GROT_GDEP', and goes on in small displacements, where "
            "its forces would act along the axes that it began with",
            problem.model->mesh->cell_name(cell)),
        keywords.span_of(keywords.has("EVOL_NOLI") ? "EVOL_NOLI" : "SIGM"), "go on with DEFORMATION='GROT_GDEP'");
  }
}

}  // namespace comma::commands
