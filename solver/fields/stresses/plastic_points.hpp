// The constants of von Mises plasticity at the integration points of a model.
#pragma once

#include "solver/fields/points/continuum_points.hpp"
#include "solver/materials/behaviour/hardening.hpp"
#include "solver/model/behaviour.hpp"

namespace comma::solver {

/// At point `g` of a cell that `points` covers and whose elasticity is isotropic, with the command variables there.
/// Throws what plastic_point() does.
PlasticPoint plastic_point_at(const FieldInput& input, ContinuumPoints& points, Relation relation, int cell, int g);

}  // namespace comma::solver
