// Forces of loads on the degrees of freedom.
#pragma once

#include <span>

#include "solver/loads/load.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Adds the nodal forces and pressures of the loads at a time to `forces` (one a degree of freedom), on the initial geometry.
///
/// A plane edge from node 1 to node 2 has the tangent t = (2 - 1) / |2 - 1| and the normal n = t turned by -90 degrees, which
/// points out of a body whose boundary runs counter-clockwise; a face has its normal by the right-hand rule. Pressure p and shear
/// q act as the traction -p n + q t (U4.44.01, PRES_REP). Axisymmetric loads are per radian.
///
/// Throws Error `unknown-dof` for a force on a component that its node does not carry, `not-a-skin` for a pressure on a
/// cell that is no skin cell, `unsupported` for shear on a face.
void add_external_forces(const Model& model, const DofMap& dofs, std::span<const AppliedLoad> loads, double time,
                         std::span<long double> forces);

}  // namespace comma::solver
