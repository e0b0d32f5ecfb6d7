// T^T K T for a symmetric K, many times with the same pattern.
#pragma once

#include <vector>

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// Where each entry of K goes in T^T K T, and with which weight: found once, then each product is one pass over K's
/// values.
class Congruence {
 public:
  /// Beyond, contributions take more memory (16 bytes each) than they save time: a node that relations tie to thousands
  /// has that many.
  static constexpr double most_contributions = 2.0e7;

  /// `pattern`: lower triangle (n x n); `transformation`: T (n x m). With more contributions than `most` products are
  /// made of whole matrices, without the list.
  Congruence(const SymmetricMatrix& pattern, const Eigen::SparseMatrix<double>& transformation,
             double most = most_contributions);

  /// Whether a matrix has the pattern that the constructor saw.
  bool fits(const SymmetricMatrix& matrix) const;
  /// T^T K T, lower triangle (m x m). What contributions that cancel leave of an entry, 1e-13 of their size or less, is
  /// zero: the rounding of a body that relations make rigid holds nothing (not where there are too many to list).
  SymmetricMatrix apply(const SymmetricMatrix& matrix) const;

 private:
  std::vector<int> outer_, inner_;  ///< the pattern seen
  std::vector<int> sources_, targets_;
  std::vector<double> weights_;                 ///< empty when all are 1
  SymmetricMatrix product_;                     ///< the product's pattern, with zeros
  Eigen::SparseMatrix<double> transformation_;  ///< where products are made of whole matrices
};

}  // namespace comma::solver
