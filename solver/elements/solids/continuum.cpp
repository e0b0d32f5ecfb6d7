// Which continuum element a cell gets.
#include <algorithm>
#include <utility>

#include "solver/elements/element_block.hpp"

namespace comma::solver {

namespace {

/// One point of reduced integration leaves hourglass modes to quadrangles, whose stabilisation is not known here
/// (R3.06.10).
bool needs_stabilisation(CellType type, Formulation formulation) {
  const bool reduced = formulation == Formulation::plane_strain_reduced ||
                       formulation == Formulation::plane_stress_reduced ||
                       formulation == Formulation::axisymmetric_reduced;
  return reduced && type == CellType::quad4;
}

}  // namespace

bool keeps_memory(const BlockInput& input, std::span<const int> cells) {
  CellBehaviour behaviour = input.behaviour_of(cells.front());
  if (behaviour.kinematics == Kinematics::green_lagrange && is_plane_stress(input.model.formulations[cells.front()]))
    return true;
  if (!has_memory(behaviour)) return false;
  behaviour.from_initial_state = false;
  if (has_memory(behaviour)) return true;
  return std::ranges::all_of(cells, [&](int cell) {
    return std::holds_alternative<IsotropicElasticity>(*elastic_material(input, cell).elasticity);
  });
}

std::unique_ptr<ElementBlock> make_continuum_block(const BlockInput& input, std::vector<int> cells) {
  const int cell = cells.front();
  const Formulation formulation = input.model.formulations[cell];
  if (needs_stabilisation(input.model.mesh->cell_types[cell], formulation))
    throw_unsupported_element(input.model, cell);
  const bool solid = continuum_dimension(formulation) == 3;
  if (is_stabilised(formulation, input.model.mesh->cell_types[cell]))
    return make_stabilised_block(input, std::move(cells));
  if (mixed_field_count(formulation) > 0)
    return solid ? make_mixed_solid_block(input, std::move(cells)) : make_mixed_plane_block(input, std::move(cells));
  if (keeps_memory(input, cells))
    return solid ? make_inelastic_solid_block(input, std::move(cells))
                 : make_inelastic_plane_block(input, std::move(cells));
  return solid ? make_solid_block(input, std::move(cells)) : make_plane_block(input, std::move(cells));
}

}  // namespace comma::solver
