// Materials and their distribution over a mesh.
#pragma once

#include <memory>
#include <optional>
#include <vector>

namespace comma::solver {

/// Isotropic linear elasticity. Stresses in the unit of `young`.
struct IsotropicElasticity {
  double young = 0.0;      ///< Young's modulus, > 0
  double poisson = 0.0;    ///< in (-1, 0.5)
  double density = 0.0;
  double expansion = 0.0;  ///< coefficient of thermal expansion
};

struct Material {
  std::optional<IsotropicElasticity> elasticity;
};

/// The material of each cell; null where none is given.
struct MaterialField {
  std::vector<std::shared_ptr<const Material>> by_cell;
};

}  // namespace comma::solver
