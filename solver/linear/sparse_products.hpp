// Products of dense matrices with sparse ones, on all cores.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "solver/linear/row_matrix.hpp"

namespace comma::solver {

/// D S (n x k) for a dense D (n x m) and a sparse S (m x k).
Eigen::MatrixXd product(const Eigen::MatrixXd& dense, const Eigen::SparseMatrix<double>& sparse);
/// S D (n x k) for a sparse S (n x m) and a dense D (m x k).
Eigen::MatrixXd product(const RowMatrix& sparse, const Eigen::MatrixXd& dense);

}  // namespace comma::solver
