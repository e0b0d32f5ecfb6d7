// Eigenvalues of small dense symmetric matrices. Compiled once: Eigen's decompositions cost seconds in every file that
// instantiates them.
#pragma once

#include <Eigen/Dense>

namespace comma::solver {

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< rising
  Eigen::MatrixXd vectors;  ///< orthonormal columns, in the order of the values
};

/// Only the lower triangle of `matrix` is read.
SymmetricEigen symmetric_eigen(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

}  // namespace comma::solver
