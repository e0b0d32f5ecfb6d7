#include "solver/elements/element_block.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/elements/cell_material.hpp"
#include "solver/error.hpp"
#include "solver/materials/elasticity.hpp"

namespace comma::solver {

void throw_no_energies(std::string_view elements, const std::string& cell) {
  throw Error(
      "unsupported", fmt::format("comma does not compute energies of {}, such as {}", elements, cell),
      "take ENEL_ELGA of CALC_CHAMP, which other cells have, and integrate it over those (POST_ELEM, INTEGRALE)");
}

void throw_unsupported_element(const Model& model, int cell) {
  throw Error("unsupported", fmt::format("there is no element of the formulation asked for on cell {} ({})",
                                         model.mesh->cell_name(cell), name_of(model.mesh->cell_types[cell])));
}

CellMaterial elastic_material(const BlockInput& input, int cell) {
  const CellMaterial result = cell_material(input.model, input.materials, input.properties, cell);
  if (!is_constant(*result.elasticity)) return result;
  if (const auto* isotropic = std::get_if<IsotropicElasticity>(result.elasticity))
    moduli(*isotropic, MaterialPoint());
  else
    solid_stiffness(result, MaterialPoint());
  return result;
}

const IsotropicElasticity& isotropic_material(const BlockInput& input, int cell) {
  const auto* isotropic =
      std::get_if<IsotropicElasticity>(cell_material(input.model, input.materials, input.properties, cell).elasticity);
  if (isotropic == nullptr) {
    const bool is_continuum = continuum_dimension(input.model.formulations[static_cast<std::size_t>(cell)]) > 0;
    throw Error("unsupported",
                fmt::format("the {} on cell {} has an anisotropic material, but needs an isotropic one",
                            is_continuum ? "element" : "bar, beam or plate", input.model.mesh->cell_name(cell)),
                is_continuum ? "in continua without pressure as an unknown anisotropic elasticity goes with "
                               "DEFORMATION='PETIT', and with 'GREEN_LAGRANGE' but for plane stress"
                             : "");
  }
  if (isotropic->young.is_constant() && isotropic->poisson.is_constant()) moduli(*isotropic, MaterialPoint());
  return *isotropic;
}

std::vector<int> gather_nodes(const Mesh& mesh, std::span<const int> cells) {
  std::vector<int> nodes;
  nodes.reserve(cells.size() * mesh.cell(cells.front()).size());
  for (const int cell : cells) {
    const auto of_cell = mesh.cell(cell);
    nodes.insert(nodes.end(), of_cell.begin(), of_cell.end());
  }
  return nodes;
}

void ElementBlock::add_initial_stress_forces(std::span<const double> stresses, ForceSum) const {
  if (std::ranges::all_of(stresses, [](double each) { return std::isnan(each) || each == 0.0; })) return;
  throw Error("unsupported", "initial stresses as a load (PRE_SIGM) are known of solids, plane bodies and bars alone",
              "make a field of these cells alone (CREA_CHAMP, GROUP_MA)");
}

void ElementBlock::add_variable_forces(const Eigen::VectorXd& u, const VariableState& state, ForceSum forces) const {
  if (has_memory()) return;
  std::vector<long double> held(forces.size(), 0.0L);
  add_internal_forces(u, state, held);
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] -= held[i];
}

void ElementBlock::add_geometric_stiffness(std::span<const double>, const VariableState&, std::span<const int>,
                                           double*) const {
  throw Error("unsupported", "the stiffness that stresses add is not known of this kind of element");
}

}  // namespace comma::solver
