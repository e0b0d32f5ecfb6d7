#include "commands/analysis/behaviour_reading.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "commands/selection.hpp"
#include "interpreter/diagnostic.hpp"
#include "solver/materials/behaviour/restoration.hpp"

namespace comma::commands {

using interpreter::Keywords;

namespace {

// RELATION and DEFORMATION in the solver's words.
constexpr std::pair<std::string_view, solver::Relation> relations[] = {
    {"ELAS", solver::Relation::elastic},
    {"ELAS_HYPER", solver::Relation::hyperelastic},
    {"VMIS_ISOT_LINE", solver::Relation::isotropic_linear},
    {"VMIS_ISOT_TRAC", solver::Relation::isotropic_traction},
    {"VMIS_ISOT_PUIS", solver::Relation::isotropic_power},
    {"ELAS_VMIS_LINE", solver::Relation::reversible_linear},
    {"ELAS_VMIS_TRAC", solver::Relation::reversible_traction},
    {"ELAS_VMIS_PUIS", solver::Relation::reversible_power},
    {"VMIS_ISOT_NL", solver::Relation::isotropic_nonlinear},
    {"VMIS_CINE_LINE", solver::Relation::kinematic_linear},
    {"VMIS_ECMI_LINE", solver::Relation::mixed_linear},
    {"VMIS_ECMI_TRAC", solver::Relation::mixed_traction},
    {"VMIS_ASYM_LINE", solver::Relation::asymmetric_linear},
    {"DIS_CONTACT", solver::Relation::contact_spring},
    {"DIS_CHOC", solver::Relation::contact_spring},
    {"DIS_BILI_ELAS", solver::Relation::bilinear_spring},
    {"DIS_ECRO_CINE", solver::Relation::hardening_spring},
};
constexpr std::pair<std::string_view, solver::Kinematics> kinematics[] = {
    {"PETIT", solver::Kinematics::small},          {"GREEN_LAGRANGE", solver::Kinematics::green_lagrange},
    {"GDEF_LOG", solver::Kinematics::logarithmic}, {"SIMO_MIEHE", solver::Kinematics::multiplicative},
    {"PETIT_REAC", solver::Kinematics::updated},   {"GROT_GDEP", solver::Kinematics::large_rotations},
};

// As Code_Aster 17.3.
void require_restorable(const Keywords& keywords, solver::Relation relation) {
  if (solver::may_be_restored(relation)) return;
  throw interpreter::DiagnosticError(
      "unsupported",
      fmt::format("COMPORTEMENT: POST_INCR='REST_ECRO' does not restore the hardening of RELATION='{}'",
                  keywords.text("RELATION")),
      keywords.span_of("POST_INCR"), "it goes with VMIS_ISOT_LINE, VMIS_ISOT_TRAC and VMIS_ECMI_LINE");
}

// Of solids and plane bodies alone, as in Code_Aster 17.3.
void require_restorable(const solver::BehaviourOfCells& behaviours, const solver::Model& model, const Keywords& call) {
  for (std::size_t cell = 0; cell < behaviours.size(); ++cell) {
    const solver::Formulation formulation = model.formulations[cell];
    const bool is_body = solver::continuum_dimension(formulation) > 0 && solver::mixed_field_count(formulation) == 0;
    if (!behaviours[cell].restores_hardening || is_body || formulation == solver::Formulation::none) continue;
    const auto& occurrences = call.factors("COMPORTEMENT");
    const auto restoring = std::ranges::find_if(occurrences, [](const Keywords& any) { return any.has("POST_INCR"); });
    throw interpreter::DiagnosticError(
        "unsupported",
        fmt::format("COMPORTEMENT: POST_INCR='REST_ECRO' restores the hardening of solids and plane bodies without a "
                    "pressure among their unknowns, and cell {} is none",
                    model.mesh->cell_name(static_cast<int>(cell))),
        restoring->span_of("POST_INCR"), "name groups of such cells (GROUP_MA)");
  }
}

solver::CellBehaviour behaviour_of(const Keywords& keywords) {
  const auto relation =
      std::ranges::find(relations, keywords.text("RELATION"), &std::pair<std::string_view, solver::Relation>::first);
  const auto deformation = std::ranges::find(kinematics, keywords.text("DEFORMATION"),
                                             &std::pair<std::string_view, solver::Kinematics>::first);
  solver::CellBehaviour behaviour{deformation->second, relation->second};
  for (const char* const name : {"RESI_INTE", "RESI_INTE_RELA"})
    if (keywords.has(name)) behaviour.return_tolerance = keywords.real(name);
  if (keywords.has("POST_INCR")) {
    require_restorable(keywords, relation->second);
    behaviour.restores_hardening = true;
  }
  return behaviour;
}

// In continua GROT_GDEP is Green and Lagrange's measure (U4.51.11), the older word for it; bars stay in small
// displacements with it (Code_Aster 17.3; the alarm `small-bars` tells).
solver::CellBehaviour behaviour_on(solver::CellBehaviour behaviour, const solver::Model& model, int cell,
                                   const solver::InitialState* initial, bool has_variables) {
  const bool is_solid = solver::continuum_dimension(model.formulations[static_cast<std::size_t>(cell)]) > 0;
  if (is_solid && behaviour.kinematics == solver::Kinematics::large_rotations)
    behaviour.kinematics = solver::Kinematics::green_lagrange;
  if (behaviour.kinematics == solver::Kinematics::large_rotations &&
      solver::is_bar(model.formulations[static_cast<std::size_t>(cell)]))
    behaviour.kinematics = solver::Kinematics::small;
  const bool has_whole_strain =
      is_solid && behaviour.relation == solver::Relation::elastic && behaviour.kinematics == solver::Kinematics::small;
  const bool counts_changes = is_solid && behaviour.relation == solver::Relation::elastic && has_variables &&
                              behaviour.kinematics == solver::Kinematics::green_lagrange;
  behaviour.from_initial_state = initial != nullptr ? initial->stresses || !has_whole_strain : counts_changes;
  return behaviour;
}

}  // namespace

std::vector<int> cells_of_behaviour(const Keywords& occurrence, const solver::Mesh& mesh) {
  if (names_a_place(occurrence, cell_places)) return selected_cells(occurrence, mesh);
  std::vector<int> all(static_cast<std::size_t>(mesh.cell_count()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::shared_ptr<const solver::BehaviourOfCells> behaviours_of(const Keywords& call, const solver::Model& model,
                                                              const solver::InitialState* initial, bool has_variables) {
  const solver::Mesh& mesh = *model.mesh;
  auto result = std::make_shared<solver::BehaviourOfCells>(static_cast<std::size_t>(mesh.cell_count()));
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    (*result)[static_cast<std::size_t>(cell)] = behaviour_on({}, model, cell, initial, has_variables);
  for (const Keywords& keywords : call.factors("COMPORTEMENT")) {
    const solver::CellBehaviour behaviour = behaviour_of(keywords);
    for (const int cell : cells_of_behaviour(keywords, mesh))
      (*result)[static_cast<std::size_t>(cell)] = behaviour_on(behaviour, model, cell, initial, has_variables);
  }
  require_restorable(*result, model, call);
  if (std::ranges::all_of(*result, [](const auto& each) { return each == solver::CellBehaviour{}; })) return nullptr;
  return result;
}

}  // namespace comma::commands
