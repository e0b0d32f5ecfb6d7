// The pattern of a matrix with one row for unknowns that are tied to the same ones.
#pragma once

#include <vector>

#include "solver/linear/linear_solver.hpp"

namespace comma::solver {

/// Rows that follow each other and have entries in the same columns, as the translations of a node have, make a group:
/// an order of the groups is one of the unknowns, which fills the factor as little, and is found in a fraction of the
/// time (indistinguishable nodes: George and Liu, SIAM Review 31, 1989).
struct QuotientPattern {
  std::vector<int> first_rows;     ///< of each group, and the number of rows at the end
  std::vector<int> column_starts;  ///< lower triangle of the groups' pattern, by columns
  std::vector<int> rows;           ///< rising in each column, the diagonal first

  int size() const { return static_cast<int>(first_rows.size()) - 1; }
  /// The order of the matrix's rows that an order of the groups means; both say which comes i-th.
  std::vector<int> expanded(const int* order) const;
};

QuotientPattern quotient_pattern(const SymmetricMatrix& matrix);

}  // namespace comma::solver
