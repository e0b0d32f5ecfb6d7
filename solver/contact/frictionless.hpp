// Contact without friction, with its points at the nodes: inequalities after all.
#pragma once

#include <optional>

#include "solver/contact/condensed_contact.hpp"

namespace comma::solver {

/// Where each multiplier belongs to one point, neither friction, penalties, springs nor points that stay closed take part, and the
/// law of contact is: gap >= 0, force >= 0, and their product vanishes. That is what the active-set method on the Schur complement
/// solves (solver/unilateral/active_set.hpp), with a Cholesky factor of the closed rows in place of the LU of jumps and multipliers.
/// Nothing, and the state as it was, where the problem is another one, or the conditions contradict each other.
std::optional<CondensedSolution> solve_frictionless(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state);

}  // namespace comma::solver
