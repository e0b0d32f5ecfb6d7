#include "solver/linear/quotient_pattern.hpp"

#include <cstdint>

namespace comma::solver {
namespace {

/// So that sums tell sets apart (the finaliser of SplitMix64).
std::uint64_t scattered(int column) {
  std::uint64_t bits = (static_cast<std::uint64_t>(column) + 1) * 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

/// A number for the columns in which each row has entries. Rows with the same number by chance would cost fill, not
/// digits.
std::vector<std::uint64_t> keys_of_rows(const SymmetricMatrix& matrix) {
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(matrix.rows()), 0);
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (SymmetricMatrix::InnerIterator it(matrix, column); it; ++it) {
      keys[it.row()] += scattered(column);
      if (it.row() != column) keys[column] += scattered(static_cast<int>(it.row()));
    }
  return keys;
}

}  // namespace

QuotientPattern quotient_pattern(const SymmetricMatrix& matrix) {
  QuotientPattern pattern;
  const std::vector<std::uint64_t> keys = keys_of_rows(matrix);
  std::vector<int> groups(keys.size());
  for (std::size_t row = 0; row < keys.size(); ++row) {
    if (row == 0 || keys[row] != keys[row - 1]) pattern.first_rows.push_back(static_cast<int>(row));
    groups[row] = static_cast<int>(pattern.first_rows.size()) - 1;
  }
  for (const int column : pattern.first_rows) {
    pattern.column_starts.push_back(static_cast<int>(pattern.rows.size()));
    int last = -1;
    for (SymmetricMatrix::InnerIterator it(matrix, column); it; ++it)
      if (const int group = groups[it.row()]; group != last) pattern.rows.push_back(last = group);
  }
  pattern.column_starts.push_back(static_cast<int>(pattern.rows.size()));
  pattern.first_rows.push_back(static_cast<int>(matrix.rows()));
  return pattern;
}

std::vector<int> QuotientPattern::expanded(const int* order) const {
  std::vector<int> rows_in_order;
  rows_in_order.reserve(static_cast<std::size_t>(first_rows.back()));
  for (int place = 0; place < size(); ++place)
    for (int row = first_rows[order[place]]; row < first_rows[order[place] + 1]; ++row) rows_in_order.push_back(row);
  return rows_in_order;
}

}  // namespace comma::solver
