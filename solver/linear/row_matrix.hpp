// Sparse matrices by rows, one a condition.
#pragma once

#include <algorithm>

#include <Eigen/Sparse>

namespace comma::solver {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Whether both have the same entries in the same places; compressed ones.
inline bool same_matrix(const RowMatrix& a, const RowMatrix& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols() || a.nonZeros() != b.nonZeros()) return false;
  return std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()) &&
         std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr());
}

}  // namespace comma::solver
