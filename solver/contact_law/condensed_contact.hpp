// Solves the mixed problem of contact on its own rows.
#pragma once

#include <Eigen/Dense>

#include "solver/contact_law/condensed_problem.hpp"
#include "solver/unilateral/schur_complement.hpp"

namespace comma::solver {

enum class CondensedVerdict : std::uint8_t { solved, too_many_iterations };

struct CondensedSolution {
  CondensedVerdict verdict = CondensedVerdict::solved;
  Eigen::VectorXd forces;  ///< on the rows
  int iterations = 0;
  int changes = 0;      ///< of status, beside the start
  bool is_far = false;  ///< solved, and further away than bodies go (CondensedProblem::farthest): of solve_condensed,
                        ///< where there is nothing nearer; it says what nothing holds
  /// Points have a share_augmentation, and no solution by shares was found: it is one by shears.
  bool by_shears = false;
};

/// Newton's method with statuses held during an iteration (the primal-dual active set of Hintermueller, Ito and
/// Kunisch, SIAM Journal on Optimization 13, 2002). All points that ask for it change status at once; once a set of
/// statuses comes back, one at a time, the first in order, which is finite where the compliance is positive definite
/// and nothing rubs (Murty, 1974).
CondensedSolution solve_condensed(SchurComplement& schur, const CondensedProblem& problem, CondensedState& state);

}  // namespace comma::solver
