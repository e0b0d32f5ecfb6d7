// Nodal forces and reactions from a displacement (CALC_CHAMP FORCE, U4.81.04).
#pragma once

#include <span>

#include "solver/elements/assembler.hpp"
#include "solver/elements/follower_forces.hpp"

namespace comma::solver {

/// The values of a nodal field over the degrees of freedom. Throws Error `incompatible-field` where one is absent.
Eigen::VectorXd to_dofs(const NodalField& field, const DofMap& dofs);

/// FORC_NODA: the forces of the stresses of a displacement field, those of the strains that the loads impose included.
/// Materials with a memory need `stresses` (SIEF_ELGA).
NodalField nodal_forces(const Assembler& assembler, const DofMap& dofs, const NodalField& displacement,
                        std::span<const AppliedLoad> loads, double time, const ElementField* stresses = nullptr);

/// REAC_NODA: internal minus external forces, those that follow the body included; zero where nothing is imposed, the
/// reaction where something is.
NodalField nodal_reactions(const Assembler& assembler, const DofMap& dofs, const NodalField& displacement,
                           std::span<const AppliedLoad> loads, const FollowerForces& followers, double time,
                           const ElementField* stresses = nullptr);

}  // namespace comma::solver
