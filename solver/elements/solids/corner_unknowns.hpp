// What mixed elements have at their corners besides the displacements of all their nodes, and where it enters the
// stiffness.
#pragma once

#include <span>
#include <vector>

#include "solver/elements/sparse_pattern.hpp"

namespace comma::solver {

/// The linear cell on the corners of a quadratic one that has further nodes in the middle of its edges alone. Throws
/// for others what throw_unsupported_element() throws.
CellType linear_cell(const Model& model, int cell);

/// One or two fields (the pressure, then the swelling) at the first `corners` nodes of like cells; unknowns of an
/// element are numbered field by field.
class CornerUnknowns {
 public:
  /// Keeps references to its arguments.
  CornerUnknowns(const SparsePattern& pattern, const DofMap& dofs, int fields, int corners);

  int fields() const { return static_cast<int>(fields_.size()); }
  int count() const { return fields() * corners_; }
  /// Writes the degrees of freedom (`count`) of an element with these nodes.
  void dofs(std::span<const int> nodes, int* out) const;

  /// Adds what couples these unknowns with displacements and with each other: `coupling` (displacements x count) and
  /// `own` (stride x count, of which the first `count` rows count, symmetric), column by column, to the value array of
  /// a matrix of the pattern.
  void add(std::span<const int> nodes, std::span<const int> displacements, const double* coupling, const double* own,
           int stride, std::span<const int> column_starts, double* values) const;

 private:
  std::ptrdiff_t place(int row, int column, std::span<const int> column_starts) const;

  const SparsePattern& pattern_;
  const DofMap& dofs_;
  std::vector<Component> fields_;
  int corners_;
};

}  // namespace comma::solver
