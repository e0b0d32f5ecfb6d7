// Gaps of paired slave nodes as inequality rows.
#pragma once

#include <span>
#include <vector>

#include "solver/contact/pairing.hpp"
#include "solver/model/model.hpp"
#include "solver/unilateral/inequality.hpp"

namespace comma::solver {

/// For each paired slave node s on a facet with weights N_i and normal n (from master to slave):
///
///     -n . (u_s - sum N_i u_i) <= gap0,   gap0 = n . (X_s - sum N_i X_i) - thickness
///
/// with u the whole displacement and X the initial places, so that the right-hand side minus the left is the present
/// gap (R5.03.50, section 4: the linearised gap, whose reference cancels since the rows are linear). A multiplier is
/// the normal force, positive in compression: +lambda n on the slave, -lambda N_i n on the master's nodes. Rows over
/// all degrees of freedom, one a paired entry of `pairs` in their order; `row_pairs` gets the entries' indices. Throws
/// Error `unknown-dof` where a node lacks a displacement along the normal.
Inequalities gap_rows(std::span<const ContactPair> pairs, const Mesh& mesh, const DofMap& dofs,
                      std::vector<int>& row_pairs);

}  // namespace comma::solver
