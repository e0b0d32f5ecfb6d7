// The compliance of many conditions from a Cholesky factor.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "solver/linear/shared_library.hpp"

namespace comma::solver {

/// A view of L (n x n, P K P^T = L L^T) by supernodes, columns whose rows below are the same. All indices from 0.
struct SupernodalFactor {
  int size = 0;                        ///< n
  int count = 0;                       ///< of supernodes
  const int* first_columns = nullptr;  ///< count + 1
  const int* row_starts = nullptr;     ///< count + 1, into `rows`
  const int* value_starts = nullptr;   ///< count + 1, into `values`
  const int* rows = nullptr;           ///< of each supernode, rising, its own columns first
  const double* values = nullptr;      ///< of each, column by column
  const int* order = nullptr;          ///< P: the row of K that is i-th in L (n)
};

/// The kernels, by their Fortran names.
struct BlasKernels {
  using Solve = void(const char* side, const char* triangle, const char* transposed, const char* unit, const int* m,
                     const int* n, const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
  using Multiply = void(const char* transposed_a, const char* transposed_b, const int* m, const int* n, const int* k,
                        const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
                        const double* beta, double* c, const int* ldc);
  using Square = void(const char* triangle, const char* transposed, const int* n, const int* k, const double* alpha,
                      const double* a, const int* lda, const double* beta, double* c, const int* ldc);

  /// Throws Error `missing-library`.
  explicit BlasKernels(const SharedLibrary& library);

  Solve* solve;        ///< dtrsm
  Multiply* multiply;  ///< dgemm
  Square* square;      ///< dsyrk
};

/// rows K^-1 rows^T (m x m, symmetric) = Y^T Y with Y = L^-1 P rows^T, for sparse rows (m x n). Y is made supernode by
/// supernode from the leaves to the root, each with those conditions alone that its subtree touches, and is not kept
/// (the fronts of a multifrontal factorisation that takes the rows along as a border: Duff and Reid, ACM Trans. Math.
/// Software 9, 1983). It costs a share of the factorisation, where m solutions would be m passes over the whole factor.
/// Exact to the rounding of an unrefined factor.
Eigen::MatrixXd supernodal_compliance(const SupernodalFactor& factor, const BlasKernels& blas,
                                      const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows);

}  // namespace comma::solver
