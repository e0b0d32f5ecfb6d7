// Iterative refinement, whatever the matrix and its factors.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "solver/linear/double_double.hpp"

namespace comma::solver {

/// What refinement needs to know of A x = b and of the factors of R A C, R and C diagonal.
struct RefinedSystem {
  /// Writes b - A (high + low) (n), summed in doubled precision in `sums` (n) and rounded at the end.
  std::function<void(const double* b, const double* high, const double* low, std::vector<DoubleDouble>& sums,
                     double* result)>
      residual;
  /// Overwrites the columns (n x k) by (R A C)^-1 times them, as well as the factors can.
  std::function<void(Eigen::Ref<Eigen::MatrixXd>)> solve_scaled;
  const Eigen::VectorXd& row_factors;     ///< R (n)
  const Eigen::VectorXd& column_factors;  ///< C (n)
  double norm = 0.0;                      ///< |A|_inf
};

/// Overwrites the columns (n x k) by A^-1 times them: x += C (R A C)^-1 R (b - A x), at most `steps` times after the
/// first solution. The residual is summed in doubled precision and x carries a low-order part, so the forward error
/// falls to one rounding of x as long as the factors are worth anything, that is up to condition numbers of about 1e15
/// (Demmel, Hida, Kahan, Li, Mukherjee, Riedy, "Error bounds from extra-precise iterative refinement", ACM Trans. Math.
/// Software 32, 2006). Steps end as soon as a correction no longer changes x. Returns the largest |b - A x|_inf /
/// (|A|_inf |x|_inf + |b|_inf) of the columns, infinity where it is not finite.
double refine(const RefinedSystem& system, int steps, Eigen::Ref<Eigen::MatrixXd> rhs);

}  // namespace comma::solver
