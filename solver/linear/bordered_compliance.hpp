// The compliance of many conditions from one factorisation.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// rows K^-1 rows^T (m x m, symmetric) for a positive definite K (n x n) and sparse rows (m x n): minus the Schur
/// complement of K in
///
///     [ K     rows^T ]
///     [ rows    0    ]
///
/// which a multifrontal factorisation gives for little more than that of K, where m solutions would cost m passes over
/// the factor. Exact to the rounding of an unrefined factor. Throws Error `out-of-memory`, `linear-solver`.
Eigen::MatrixXd bordered_compliance(const SymmetricMatrix& stiffness,
                                    const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows);

}  // namespace comma::solver
