// Sparse Gauss-Jordan elimination of linear relations whose right-hand sides are not known yet.
#pragma once

#include <span>
#include <utility>
#include <vector>

namespace comma::solver {

/// (index, coefficient), indices rising, each once.
using SparseRow = std::vector<std::pair<int, double>>;

/// Relation i reads sum over its terms of coefficient * u[index] = c[i]. After elimination:
struct GaussJordan {
  /// u[pivot] + sum of others = sum of combination * c; `others` holds columns without a pivot only.
  struct Row {
    int pivot;
    SparseRow others;
    SparseRow combination;
  };
  std::vector<Row> rows;
  /// Relations that follow from those before them: 0 = sum of combination * c must hold.
  std::vector<SparseRow> dependencies;
};

/// A coefficient this small beside those it was computed from is rounding: the terms of a relation cancelled.
inline constexpr double cancellation_tolerance = 1e-12;
/// Pivot candidates closer than this are as good as each other numerically.
inline constexpr double pivot_tie_tolerance = 1e-9;

/// Relations of a single term come first (O(1) each), then the others, short before long. The pivot of a relation is
/// its largest coefficient; among equals, the column that appears in fewest relations, so that few rows fill in.
GaussJordan gauss_jordan(std::span<const SparseRow> relations, int columns);

}  // namespace comma::solver
