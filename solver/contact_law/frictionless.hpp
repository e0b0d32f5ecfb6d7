// Contact without friction, with its points at the nodes: inequalities after all.
#pragma once

#include <optional>

#include "solver/contact_law/condensed_contact.hpp"

namespace comma::solver {

/// Where each multiplier belongs to one point, neither friction, penalties, springs nor points that stay closed take
/// part, and the law of contact is: gap >= 0, force >= 0, and their product vanishes. That is what the active-set
/// method on the Schur complement solves (solver/unilateral/active_set.hpp), with a Cholesky factor of the closed rows
/// in place of the LU of jumps and multipliers. Nothing, and the state as it was, where the problem is another one, or
/// the conditions contradict each other.
std::optional<CondensedSolution> solve_frictionless(SchurComplement& schur, const CondensedProblem& problem,
                                                    CondensedState& state);

/// The same for bodies that contact alone holds, where springs stand in for a support: they stay, but each round begins
/// where the body was after the last one, so that they bear nothing in the end (the proximal point method; Rockafellar,
/// SIAM Journal on Control and Optimization 14, 1976). Conditions may depend on each other, as those of a rigid face
/// finer than what it touches, where no set of statuses has one solution. Nothing, and the state as it was, also where
/// contact does not hold the bodies.
std::optional<CondensedSolution> solve_afloat(SchurComplement& schur, const CondensedProblem& problem,
                                              CondensedState& state);

}  // namespace comma::solver
