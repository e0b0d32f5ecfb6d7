#include "solver/elements/sparse_pattern.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// The cells around each node, as one array with starts.
struct NodeCells {
  std::vector<int> starts;
  std::vector<int> cells;
};

NodeCells cells_around_nodes(const Mesh& mesh, std::span<const int> cells) {
  NodeCells around{std::vector<int>(mesh.nodes.size() + 1, 0), {}};
  for (const int cell : cells) {
    for (const int node : mesh.cell(cell)) ++around.starts[node + 1];
  }
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) around.starts[n + 1] += around.starts[n];
  around.cells.resize(around.starts.back());
  std::vector<int> next(around.starts.begin(), around.starts.end() - 1);
  for (const int cell : cells) {
    for (const int node : mesh.cell(cell)) around.cells[next[node]++] = cell;
  }
  return around;
}

int dof_count(const DofMap& dofs, int node) { return dofs.first_dof(node + 1) - dofs.first_dof(node); }

}  // namespace

SparsePattern::SparsePattern(const Mesh& mesh, std::span<const int> cells, const DofMap& dofs) : dofs_(dofs) {
  const NodeCells around = cells_around_nodes(mesh, cells);
  std::vector<int> seen(mesh.nodes.size(), -1);
  neighbour_starts_.assign(1, 0);
  column_starts_.assign(1, 0);
  std::size_t entries = 0;
  for (int node = 0; node < mesh.node_count(); ++node) {
    const std::size_t first = neighbours_.size();
    for (int k = around.starts[node]; k < around.starts[node + 1]; ++k) {
      for (const int other : mesh.cell(around.cells[k])) {
        if (other > node && std::exchange(seen[other], node) != node) neighbours_.push_back(other);
      }
    }
    std::sort(neighbours_.begin() + static_cast<std::ptrdiff_t>(first), neighbours_.end());
    int height = dof_count(dofs, node);
    for (std::size_t k = first; k < neighbours_.size(); ++k) {
      offsets_.push_back(height);
      height += dof_count(dofs, neighbours_[k]);
    }
    neighbour_starts_.push_back(static_cast<int>(neighbours_.size()));
    for (int c = 0; c < dof_count(dofs, node); ++c) {
      entries += static_cast<std::size_t>(height - c);
      if (entries > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw Error("too-large", "the stiffness has more than 2^31 entries");
      }
      column_starts_.push_back(static_cast<int>(entries));
    }
  }
}

// Rows follow from the neighbours: a large matrix has no room for a second list of them.
void SparsePattern::write_rows(int* row_of_entry) const {
  const int nodes = static_cast<int>(neighbour_starts_.size()) - 1;
  const auto write = [&](int first, int node) {
    for (int row = first; row < dofs_.first_dof(node + 1); ++row) *row_of_entry++ = row;
  };
  for (int node = 0; node < nodes; ++node) {
    for (int dof = dofs_.first_dof(node); dof < dofs_.first_dof(node + 1); ++dof) {
      write(dof, node);
      for (int k = neighbour_starts_[node]; k < neighbour_starts_[node + 1]; ++k)
        write(dofs_.first_dof(neighbours_[k]), neighbours_[k]);
    }
  }
}

SymmetricMatrix SparsePattern::zero_matrix() const {
  const auto size = static_cast<Eigen::Index>(column_starts_.size()) - 1;
  SymmetricMatrix matrix(size, size);
  matrix.resizeNonZeros(column_starts_.back());
  std::copy(column_starts_.begin(), column_starts_.end(), matrix.outerIndexPtr());
  write_rows(matrix.innerIndexPtr());
  std::fill_n(matrix.valuePtr(), column_starts_.back(), 0.0);
  return matrix;
}

int SparsePattern::pair_offset(int row, int column) const {
  const auto first = neighbours_.begin() + neighbour_starts_[column];
  const auto last = neighbours_.begin() + neighbour_starts_[column + 1];
  return offsets_[static_cast<std::size_t>(std::lower_bound(first, last, row) - neighbours_.begin())];
}

ElementMap::ElementMap(const SparsePattern& pattern, const DofMap& dofs, ComponentMask components,
                       int nodes_per_element, std::vector<int> nodes)
    : dofs_(dofs), mask_(components), nodes_per_element_(nodes_per_element), nodes_(std::move(nodes)) {
  for (int c = 0; c < solver::component_count; ++c) {
    if (contains(mask_, static_cast<Component>(c))) component_list_[component_count_++] = static_cast<Component>(c);
  }
  const auto pairs = static_cast<std::size_t>(nodes_per_element_ * (nodes_per_element_ - 1) / 2);
  pair_offsets_.reserve(pairs * static_cast<std::size_t>(element_count()));
  for (int element = 0; element < element_count(); ++element) {
    const auto local = this->nodes(element);
    for (int i = 0; i < nodes_per_element_; ++i) {
      for (int j = 0; j < i; ++j) {
        const auto [low, high] = std::minmax(local[i], local[j]);
        pair_offsets_.push_back(low == high ? 0 : pattern.pair_offset(high, low));
      }
    }
  }
}

int ElementMap::slot(int node, int component) const {
  const ComponentMask mask = dofs_.components(node);
  if (mask == mask_) return component;
  return std::popcount(static_cast<ComponentMask>(mask & (mask_of(component_list_[component]) - 1)));
}

void ElementMap::dofs(int element, int* out) const {
  for (const int node : nodes(element)) {
    const int first = dofs_.first_dof(node);
    for (int c = 0; c < component_count_; ++c) *out++ = first + slot(node, c);
  }
}

void ElementMap::add_block(const double* matrix, int i, int j, int offset, int row, int column,
                           std::span<const int> column_starts, double* values) const {
  const int size = nodes_per_element_ * component_count_;
  for (int d = 0; d < component_count_; ++d) {
    const int column_slot = slot(column, d);
    const double* source = matrix + static_cast<std::ptrdiff_t>(j * component_count_ + d) * size + i * component_count_;
    double* target = values + column_starts[dofs_.first_dof(column) + column_slot] + offset - column_slot;
    for (int c = row == column ? d : 0; c < component_count_; ++c) target[slot(row, c)] += source[c];
  }
}

void ElementMap::add(int element, const double* matrix, std::span<const int> column_starts, double* values) const {
  const auto local = nodes(element);
  const int* offset =
      pair_offsets_.data() + static_cast<std::size_t>(element) * (nodes_per_element_ * (nodes_per_element_ - 1) / 2);
  for (int i = 0; i < nodes_per_element_; ++i) {
    for (int j = 0; j < i; ++j, ++offset) {
      if (local[i] >= local[j]) add_block(matrix, i, j, *offset, local[i], local[j], column_starts, values);
      // A collapsed cell has a node twice: both halves of the pair then fall on that node's diagonal block.
      if (local[j] >= local[i]) add_block(matrix, j, i, *offset, local[j], local[i], column_starts, values);
    }
    add_block(matrix, i, i, 0, local[i], local[i], column_starts, values);
  }
}

void ElementMap::append_skew_half(int element, const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                                  std::vector<Eigen::Triplet<double>>& entries) const {
  std::vector<int> dofs(static_cast<std::size_t>(matrix.rows()));
  this->dofs(element, dofs.data());
  solver::append_skew_half(dofs, matrix, entries);
}

void append_skew_half(std::span<const int> dofs, const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                      std::vector<Eigen::Triplet<double>>& entries) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      const double skew = 0.5 * (matrix(i, j) - matrix(j, i));
      const int row = dofs[static_cast<std::size_t>(i)], column = dofs[static_cast<std::size_t>(j)];
      if (row > column && skew != 0.0) entries.emplace_back(row, column, skew);
    }
  }
}

}  // namespace comma::solver
