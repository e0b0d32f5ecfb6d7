// Which continuum element a cell gets.
#include <utility>

#include "solver/elements/element_block.hpp"

namespace comma::solver {

namespace {

/// One point of reduced integration leaves hourglass modes to these cells, which need a stabilisation (R3.06.10, R3.06.11).
bool needs_stabilisation(CellType type, Formulation formulation) {
  const bool reduced = formulation == Formulation::solid_reduced || formulation == Formulation::plane_strain_reduced ||
                       formulation == Formulation::plane_stress_reduced || formulation == Formulation::axisymmetric_reduced;
  return reduced && (type == CellType::quad4 || type == CellType::hexa8);
}

}  // namespace

std::unique_ptr<ElementBlock> make_continuum_block(const BlockInput& input, std::vector<int> cells) {
  const int cell = cells.front();
  const Formulation formulation = input.model.formulations[cell];
  if (needs_stabilisation(input.model.mesh->cell_types[cell], formulation)) throw_unsupported_element(input.model, cell);
  return continuum_dimension(formulation) == 3 ? make_solid_block(input, std::move(cells)) : make_plane_block(input, std::move(cells));
}

}  // namespace comma::solver
