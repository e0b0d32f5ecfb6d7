// Systems that are known by their products with vectors.
#pragma once

#include <functional>

#include <Eigen/Dense>

namespace comma::solver {

/// y (n) of x (n), linear.
using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct GmresOptions {
  double tolerance = 1e-10;  ///< of the residual, as a share of b (2-norms)
  int most_products = 200;   ///< a vector (n) is kept for each
};

struct GmresSolution {
  Eigen::VectorXd x;
  Eigen::VectorXd shares;  ///< x is the sum of the vectors that `matrix` was given, one after the other, times these
  bool reached = false;    ///< the tolerance
};

/// M x = b for any M by the generalised minimal residual method, not restarted (Saad and Schultz, SIAM Journal on
/// Scientific and Statistical Computing 7, 1986), on M P, with `preconditioner` P near M^-1. One product with M an
/// iteration.
GmresSolution solve_gmres(const LinearMap& matrix, const LinearMap& preconditioner, const Eigen::VectorXd& b,
                          const GmresOptions& options);

}  // namespace comma::solver
