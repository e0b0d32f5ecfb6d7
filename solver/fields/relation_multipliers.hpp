// The multipliers that a solution with Lagrange multipliers would have (R3.03.01), from one without.
#pragma once

#include <span>
#include <vector>

#include "solver/fields/field.hpp"
#include "solver/loads/load.hpp"

namespace comma::solver {

/// The multipliers of the relations of loads, Load::multipliers_per_relation equal ones for each relation, in their
/// order: B^T times their sums is minus the reactions (a field DX.., N and N.m, of displacements that obey the
/// relations). Of relations that depend on others some get 0.
std::vector<double> relation_multipliers(const DofMap& dofs, std::span<const AppliedLoad> loads,
                                         const NodalField& reactions);

}  // namespace comma::solver
