// Multipliers of A u <= b by conjugate gradients on the rows that push: one or two products with the Schur complement
// an iteration (R5.03.50).
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Dense>

#include "solver/unilateral/active_set.hpp"

namespace comma::solver {

struct AdmissibleGradientOptions {
  double tolerance = 1e-8;     ///< RESI_ABSO: largest violation left, a length
  int max_iterations = 0;      ///< ITER_GCP_MAXI; 0: `iterations_a_row` times the rows
  Eigen::VectorXd start = {};  ///< multipliers to begin with (m, >= 0); empty: zero
  /// A step ends where the first multiplier vanishes (RECH_LINEAIRE='ADMISSIBLE'); otherwise it goes on, and
  /// multipliers that would pull are set to zero.
  bool stays_admissible = true;
};

inline constexpr int iterations_a_row = 10;

/// Conjugate gradients on the rows that push or are violated, from the start given: steps go down to the lowest dual
/// along them, as far as signs allow, and directions begin anew once the rows that push have changed. Stops where no
/// row is violated, and none that pushes falls short, by more than the tolerance: how near that is to the solution
/// depends on the path, which is that of Code_Aster 17.3. `apply`: S times a vector (m). Nothing where the tolerance is
/// not met after as many iterations, or where nothing resists.
std::optional<ActiveSetSolution> solve_admissible_gradient(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply, const ActiveSetProblem& problem,
    const AdmissibleGradientOptions& options);

}  // namespace comma::solver
