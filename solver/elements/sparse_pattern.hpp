// The sparsity of the stiffness, and where each element adds to it.
#pragma once

#include <span>
#include <vector>

#include "solver/linear/linear_solver.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Lower triangle of a symmetric matrix over all degrees of freedom: two nodes of one element are coupled in all their
/// components, and every row has its diagonal. Columns of a node share their rows, so one number places a pair of
/// nodes.
class SparsePattern {
 public:
  /// `cells`: those that carry stiffness. Keeps a reference to `dofs`. Throws Error `too-large` when the entries cannot
  /// be counted in an int.
  SparsePattern(const Mesh& mesh, std::span<const int> cells, const DofMap& dofs);

  /// A matrix of this pattern, all values 0.
  SymmetricMatrix zero_matrix() const;
  std::span<const int> column_starts() const { return column_starts_; }

  /// Where the rows of node `row` (> `column`) start in the first column of node `column`, counted from that column's
  /// first entry. The nodes must share a cell.
  int pair_offset(int row, int column) const;

 private:
  void write_rows(int* row_of_entry) const;

  const DofMap& dofs_;
  std::vector<int> neighbour_starts_;  // per node: coupled nodes of higher index, rising
  std::vector<int> neighbours_;
  std::vector<int> offsets_;
  std::vector<int> column_starts_;
};

/// Where like elements read displacements and add forces and stiffness.
class ElementMap {
 public:
  /// `nodes`: nodes_per_element a piece, one element after the other. All nodes of all elements use `components`.
  ElementMap(const SparsePattern& pattern, const DofMap& dofs, ComponentMask components, int nodes_per_element,
             std::vector<int> nodes);

  int element_count() const { return static_cast<int>(nodes_.size()) / nodes_per_element_; }
  int components() const { return component_count_; }
  std::span<const int> nodes(int element) const {
    return {nodes_.data() + static_cast<std::size_t>(element) * nodes_per_element_,
            static_cast<std::size_t>(nodes_per_element_)};
  }
  /// The degrees of freedom (nodes x components, node by node) of an element.
  void dofs(int element, int* out) const;

  /// Adds a symmetric element matrix (size x size, size = nodes x components, both triangles given) to `values`, the
  /// value array of a matrix of the pattern.
  void add(int element, const double* matrix, std::span<const int> column_starts, double* values) const;
  /// append_skew_half() with the degrees of freedom of an element.
  void append_skew_half(int element, const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                        std::vector<Eigen::Triplet<double>>& entries) const;

 private:
  int slot(int node, int component) const;
  void add_block(const double* matrix, int i, int j, int offset, int row, int column,
                 std::span<const int> column_starts, double* values) const;

  const DofMap& dofs_;
  ComponentMask mask_;
  int component_count_ = 0;
  std::array<Component, component_count> component_list_{};
  int nodes_per_element_;
  std::vector<int> nodes_;
  std::vector<int> pair_offsets_;  // per element, for local pairs (i, j), i > j, row by row
};

/// Appends what is below the diagonal of the skew-symmetric half of a matrix of these degrees of freedom.
void append_skew_half(std::span<const int> dofs, const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                      std::vector<Eigen::Triplet<double>>& entries);

}  // namespace comma::solver
