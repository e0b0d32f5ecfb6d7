// Where cells are likely to lock because their material hardly changes its volume.
#pragma once

#include <optional>

#include "solver/materials/material.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

struct LockingRisk {
  int first_cell = 0;
  double poisson = 0.0;  ///< the largest among them
  int cells = 0;         ///< how many are at risk
};

/// Poisson's ratio above which fully integrated cells are at risk. A displacement that keeps the volume at every Gauss
/// point is then wanted, and such cells have too few of them (Hughes, The Finite Element Method, section 4.4). Lamé's
/// thick cylinder on 16 linear or 8 quadratic cells an edge loses 1 to 10 % of its displacement at these
/// (docs/bench.md).
inline constexpr double most_poisson_linear = 0.49;
inline constexpr double most_poisson_quadratic = 0.499;

/// The cells of solids, plane strain and bodies of revolution, fully integrated, whose isotropic material has a
/// constant Poisson's ratio beyond these bounds. Plane stress and reduced integration do not lock. Empty: none.
std::optional<LockingRisk> find_locking(const Model& model, const MaterialField& materials);

}  // namespace comma::solver
