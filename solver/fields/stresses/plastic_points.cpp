#include "solver/fields/stresses/plastic_points.hpp"

namespace comma::solver {

PlasticPoint plastic_point_at(const FieldInput& input, ContinuumPoints& points, Relation relation, int cell, int g) {
  const Material& material = *input.materials.by_cell[static_cast<std::size_t>(cell)];
  return plastic_point(std::get<IsotropicElasticity>(*material.elasticity), material.plasticity, relation,
                       points.material_point(cell, input.state, g));
}

}  // namespace comma::solver
