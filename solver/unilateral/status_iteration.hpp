// Inequality rows on a stiffness that is positive only where they hold it.
#pragma once

#include "solver/unilateral/active_set.hpp"

namespace comma::solver {

/// The problem of solve_active_set where S may have negative eigenvalues: bodies that would buckle if their contact let
/// go. There is no minimum to descend to, and there may be several solutions; this looks for one near the guess. All
/// rows that ask for it change at once (the primal-dual active set of Hintermueller, Ito and Kunisch, SIAM Journal on
/// Optimization 13, 2002); once a set comes back, one at a time. Verdicts: solved, too_many_iterations.
ActiveSetSolution solve_by_statuses(SchurComplement& schur, const ActiveSetProblem& problem);

}  // namespace comma::solver
