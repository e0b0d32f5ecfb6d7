// Multipliers of A u <= b by projected conjugate gradients: one or two products with the Schur complement an iteration.
#pragma once

#include <functional>

#include <Eigen/Dense>

#include "solver/unilateral/active_set.hpp"

namespace comma::solver {

struct ProjectedGradientOptions {
  double tolerance = 1e-8;  ///< RESI_ABSO: largest violation left, a length
  int max_iterations = 0;   ///< ITER_GCP_MAXI; 0: `default_iterations` times the rows, and a hundred, or
                            ///< `further_iterations` times as many where the tolerance is not met then
  /// PRE_COND: scale of each multiplier (m, > 0), about the inverse root of S's diagonal; empty: none.
  Eigen::VectorXd scaling;
  Eigen::VectorXd start;  ///< multipliers to begin with the best multiple of (m, >= 0); empty: zero
};

inline constexpr int default_iterations = 20;
inline constexpr int further_iterations = 10;

/// Solves the problem of active_set.hpp by MPRGP (Dostal, Optimal Quadratic Programming Algorithms, Springer 2009,
/// chapter 5): conjugate gradients on the free multipliers, a projected step of fixed length where one of them would
/// change sign, and a proportioning step where held ones pull harder than free ones push. Stops where no row exceeds
/// its bound, and no free row falls short of it, by more than the smaller of the tolerance and `gradient_share` of its
/// scale; after as many iterations as there may be, where none does by more than the tolerance. `apply`: S times a
/// vector (m). Verdict `contradictory` without rows where the dual grows without bound.
ActiveSetSolution solve_projected_gradient(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                                           const ActiveSetProblem& problem, const ProjectedGradientOptions& options);

/// Conjugate gradients in double precision come down to about this.
inline constexpr double gradient_share = 1e-11;

}  // namespace comma::solver
