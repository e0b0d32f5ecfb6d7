#include "solver/elements/solids/locking.hpp"

#include <algorithm>

namespace comma::solver {

namespace {

bool keeps_volume_everywhere(Formulation formulation) {
  return formulation == Formulation::solid || formulation == Formulation::plane_strain ||
         formulation == Formulation::axisymmetric;
}

/// Zero where it is not known, or not isotropic.
double constant_poisson(const Material* material) {
  if (material == nullptr || !material->elasticity) return 0.0;
  const auto* isotropic = std::get_if<IsotropicElasticity>(&*material->elasticity);
  if (isotropic == nullptr || !isotropic->poisson.is_constant()) return 0.0;
  return isotropic->poisson(MaterialPoint{});
}

}  // namespace

std::optional<LockingRisk> find_locking(const Model& model, const MaterialField& materials) {
  LockingRisk risk;
  for (std::size_t i = 0; i < model.formulations.size(); ++i) {
    const int cell = static_cast<int>(i);
    if (!keeps_volume_everywhere(model.formulations[i]) || model.is_skin(cell)) continue;
    const CellType type = model.mesh->cell_types[i];
    const bool linear = node_count(type) == corner_count(type);
    const double poisson = constant_poisson(materials.by_cell[i].get());
    if (poisson <= (linear ? most_poisson_linear : most_poisson_quadratic)) continue;
    if (risk.cells++ == 0) risk.first_cell = cell;
    risk.poisson = std::max(risk.poisson, poisson);
  }
  if (risk.cells == 0) return std::nullopt;
  return risk;
}

}  // namespace comma::solver
