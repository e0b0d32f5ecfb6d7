// The part of FieldComputation that computes what plates have beside the fields of other elements.
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <ranges>

#include "solver/fields/data/field_parts.hpp"
#include "solver/fields/field_computation.hpp"
#include "solver/fields/nodal_forces.hpp"
#include "solver/fields/points/extrapolation.hpp"
#include "solver/fields/stresses/plate_forces.hpp"
#include "solver/fields/stresses/plate_stresses.hpp"
#include "solver/fields/stresses/strains.hpp"

namespace comma::solver {

namespace {

bool is_plate_cell(const Model& model, int cell) {
  return is_plate(model.formulations[static_cast<std::size_t>(cell)]) && !model.is_skin(cell);
}

}  // namespace

std::vector<int> FieldComputation::plates() const {
  const Model& model = *problem_.model;
  std::vector<int> cells;
  for (int cell = 0; cell < model.mesh->cell_count(); ++cell)
    if (is_plate_cell(model, cell)) cells.push_back(cell);
  return cells;
}

bool FieldComputation::has_plates() const {
  return std::ranges::any_of(std::views::iota(0, problem_.model->mesh->cell_count()),
                             [&](int cell) { return is_plate_cell(*problem_.model, cell); });
}

Field FieldComputation::stress_field_at_points(std::size_t step) {
  if (!has_plates()) return continuum_stresses(element_field("SIEF_ELGA", step));
  return side_by_side(continuum_stresses(stresses_beside_plates(step)),
                      plate_stresses(*problem_.model, *problem_.properties, plate_forces(step)));
}

// Stresses of plates and forces of other elements have little in common.
const ElementField& FieldComputation::stresses_beside_plates(std::size_t step) {
  const ElementField& all = whole_field("SIEF_ELGA", step);
  if (!has_plates()) return all;
  const Key key(step, "SIEF_ELGA beside plates");
  if (const auto found = known_.find(key); found != known_.end()) return std::get<ElementField>(found->second);
  std::vector<int> others;
  for (int cell = 0; cell < problem_.model->mesh->cell_count(); ++cell)
    if (!is_plate(problem_.model->formulations[static_cast<std::size_t>(cell)])) others.push_back(cell);
  return std::get<ElementField>(known_.emplace(key, on_cells(all, others)).first->second);
}

ElementField FieldComputation::forces_at_nodes(std::size_t step) {
  const ElementField others = to_element_nodes(*problem_.model, stresses_beside_plates(step));
  if (!has_plates()) return others;
  return side_by_side(others, plate_forces_at_nodes(step));
}

// What plates have beside the forces of their displacements is known at the points of integration alone, and of a
// nonlinear computation Code_Aster 17.3 takes all from there.
ElementField FieldComputation::plate_forces_at_nodes(std::size_t step) {
  if (problem_.behaviours || plate_forces_beside(step)) return to_element_nodes(*problem_.model, plate_forces(step));
  return plate_forces_at_corners(step);
}

// Those of the displacements there.
ElementField FieldComputation::plate_forces_at_corners(std::size_t step) {
  ElementField forces = assembler_.plate_forces(to_dofs(displacement(step), dofs_), PlatePlaces::corners,
                                                problem_.loads, result_.steps[step].instant);
  forces.support = Support::element_node;
  return forces;
}

Field FieldComputation::stress_field_at_nodes(std::size_t step) {
  if (!has_plates()) return to_element_nodes(*problem_.model, element_field("SIGM_ELGA", step));
  const ElementField of_continua = to_element_nodes(*problem_.model, continuum_stresses(stresses_beside_plates(step)));
  return side_by_side(of_continua, plate_stresses_at_nodes(step));
}

Field FieldComputation::stresses_and_forces_at_nodes(std::size_t step) {
  const ElementField others = to_element_nodes(*problem_.model, stresses_beside_plates(step));
  return has_plates() ? side_by_side(others, plate_stresses_at_nodes(step)) : others;
}

ElementField FieldComputation::plate_stresses_at_nodes(std::size_t step) {
  return plate_stresses(*problem_.model, *problem_.properties, to_element_nodes(*problem_.model, plate_forces(step)));
}

ElementField FieldComputation::plate_forces(std::size_t step) {
  ElementField forces = assembler_.plate_forces(to_dofs(displacement(step), dofs_), PlatePlaces::integration_points,
                                                problem_.loads, result_.steps[step].instant);
  if (const auto beside = plate_forces_beside(step))
    std::ranges::transform(forces.values, beside->values, forces.values.begin(), std::plus<>());
  return forces;
}

// What plates have kept of a state that they began with, beside the forces of their displacements.
std::optional<ElementField> FieldComputation::plate_forces_beside(std::size_t step) {
  if (!holds_whole("SIEF_ELGA", step) && !began_with_stresses()) return std::nullopt;
  return assembler_.plate_forces_beside(to_dofs(displacement(step), dofs_),
                                        std::get<ElementField>(remembered("SIEF_ELGA", step)));
}

// With what initial strains (PRE_EPSI) take off: those that belong to the whole strain.
ElementField FieldComputation::whole_plate_forces(std::size_t step) {
  return assembler_.plate_forces(to_dofs(displacement(step), dofs_), PlatePlaces::integration_points, {},
                                 result_.steps[step].instant);
}

ElementField FieldComputation::layer_strains_of(const ElementField& plate_forces) const {
  return plate_layer_strains(*problem_.model, *problem_.properties, plate_strains(input(), plate_forces));
}

Field FieldComputation::total_strains(std::size_t step) {
  const ElementField of_continua = strains(input(), displacement(step), StrainKind::total);
  return has_plates() ? side_by_side(of_continua, layer_strains_of(whole_plate_forces(step))) : of_continua;
}

Field FieldComputation::total_strains_at_nodes(std::size_t step) {
  if (!has_plates()) return to_element_nodes(*problem_.model, element_field("EPSI_ELGA", step));
  const ElementField of_continua =
      to_element_nodes(*problem_.model, strains(input(), displacement(step), StrainKind::total));
  return side_by_side(of_continua, layer_strains_of(to_element_nodes(*problem_.model, whole_plate_forces(step))));
}

Field FieldComputation::means_at_nodes(const std::string& quantity, std::size_t step,
                                       std::optional<std::span<const int>> cells) {
  return single_valued_means(result_.mesh(), element_field(quantity + "_ELNO", step), cells);
}

}  // namespace comma::solver
