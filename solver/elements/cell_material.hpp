// The elastic material of a cell as its formulation needs it.
#pragma once

#include "solver/elements/slender/section.hpp"
#include "solver/materials/elasticity.hpp"
#include "solver/materials/material.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// With its axes, and with what its formulation does not ask for out of the plane. Throws Error `missing-material`
/// naming the cell.
CellMaterial cell_material(const Model& model, const MaterialField& materials, const ElementProperties& properties,
                           int cell);

}  // namespace comma::solver
