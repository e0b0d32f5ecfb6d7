// T^T K T for a symmetric K, many times with the same pattern.
#pragma once

#include <vector>

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// Where each entry of K goes in T^T K T, and with which weight: found once, then each product is one pass over K's
/// values.
class Congruence {
 public:
  /// `pattern`: lower triangle (n x n); `transformation`: T (n x m).
  Congruence(const SymmetricMatrix& pattern, const Eigen::SparseMatrix<double>& transformation);

  /// Whether a matrix has the pattern that the constructor saw.
  bool fits(const SymmetricMatrix& matrix) const;
  /// T^T K T, lower triangle (m x m). What contributions that cancel leave of an entry, 1e-13 of their size or less, is zero: the rounding of a body that relations
  /// make rigid holds nothing.
  SymmetricMatrix apply(const SymmetricMatrix& matrix) const;

 private:
  std::vector<int> outer_, inner_;  ///< the pattern seen
  std::vector<int> sources_, targets_;
  std::vector<double> weights_;  ///< empty when all are 1
  SymmetricMatrix product_;      ///< the product's pattern, with zeros
};

}  // namespace comma::solver
