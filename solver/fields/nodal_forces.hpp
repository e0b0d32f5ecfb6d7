// Nodal forces and reactions from a displacement (CALC_CHAMP FORCE, U4.81.04).
#pragma once

#include <span>

#include "solver/elements/assembler.hpp"

namespace comma::solver {

/// FORC_NODA: the internal forces of a displacement field.
NodalField nodal_forces(const Assembler& assembler, const DofMap& dofs, const NodalField& displacement);

/// REAC_NODA: internal minus external forces; zero where nothing is imposed, the reaction where something is.
NodalField nodal_reactions(const Assembler& assembler, const DofMap& dofs, const NodalField& displacement,
                           std::span<const AppliedLoad> loads, double time);

}  // namespace comma::solver
