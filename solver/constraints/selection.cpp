#include "solver/constraints/selection.hpp"

#include <utility>

namespace comma::solver {

std::vector<int> selected_unknowns(const Eigen::SparseMatrix<double>& transformation) {
  std::vector<int> unknowns(static_cast<std::size_t>(transformation.rows()), -1);
  Eigen::Index last = -1;
  for (int column = 0; column < transformation.outerSize(); ++column) {
    Eigen::SparseMatrix<double>::InnerIterator entry(transformation, column);
    if (!entry || entry.value() != 1.0 || entry.row() <= last) return {};
    last = entry.row();
    unknowns[static_cast<std::size_t>(last)] = column;
    if (++entry) return {};
  }
  return unknowns;
}

// Eigen's sparse matrices change hands by swap alone: to move one would copy it.
SymmetricMatrix select_unknowns(SymmetricMatrix&& matrix, std::span<const int> unknowns) {
  Eigen::Index kept = 0;
  for (const int unknown : unknowns) kept += unknown >= 0 ? 1 : 0;
  SymmetricMatrix selected(kept, kept);
  if (kept == matrix.cols()) {
    selected.swap(matrix);
    return selected;
  }
  int* starts = selected.outerIndexPtr();
  int* rows = matrix.innerIndexPtr();
  double* values = matrix.valuePtr();
  int entries = 0;
  for (int column = 0; column < matrix.outerSize(); ++column) {
    const int first = matrix.outerIndexPtr()[column], last = matrix.outerIndexPtr()[column + 1];
    if (unknowns[static_cast<std::size_t>(column)] < 0) continue;
    *starts++ = entries;
    for (int k = first; k < last; ++k) {
      const int row = unknowns[static_cast<std::size_t>(rows[k])];
      if (row < 0) continue;
      rows[entries] = row;
      values[entries++] = values[k];
    }
  }
  *starts = entries;
  selected.data().swap(matrix.data());
  selected.data().resize(static_cast<std::size_t>(entries));
  return selected;
}

}  // namespace comma::solver
