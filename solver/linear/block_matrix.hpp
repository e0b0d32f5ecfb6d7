// Sparse matrices of small dense blocks, by rows: what multigrid works on.
#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Dense>

namespace comma::solver {

/// Blocks of R x C; those of block row i are numbers starts[i] .. starts[i + 1] - 1, their block columns in `columns`.
template <int R, int C>
struct BlockMatrix {
  using Block = Eigen::Matrix<double, R, C>;

  std::vector<int> starts = {0};
  std::vector<int> columns;
  std::vector<Block> blocks;

  int rows() const { return static_cast<int>(starts.size()) - 1; }

  /// The sum over block row i of block times the matching segment of x.
  Eigen::Matrix<double, R, 1> row_times(int i, const Eigen::VectorXd& x) const {
    Eigen::Matrix<double, R, 1> sum = Eigen::Matrix<double, R, 1>::Zero();
    for (int k = starts[i]; k < starts[i + 1]; ++k)
      sum.noalias() += blocks[k] * x.segment<C>(static_cast<Eigen::Index>(columns[k]) * C);
    return sum;
  }

  /// y = A x.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
    for (int i = 0; i < rows(); ++i) y.segment<R>(static_cast<Eigen::Index>(i) * R) = row_times(i, x);
  }

  /// y += A^T x.
  void add_transposed(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
    for (int i = 0; i < rows(); ++i) {
      const Eigen::Matrix<double, R, 1> segment = x.segment<R>(static_cast<Eigen::Index>(i) * R);
      for (int k = starts[i]; k < starts[i + 1]; ++k)
        y.segment<C>(static_cast<Eigen::Index>(columns[k]) * C).noalias() += blocks[k].transpose() * segment;
    }
  }

  /// The block at (i, j), null where there is none.
  const Block* find(int i, int j) const {
    const auto first = columns.begin() + starts[i];
    const auto last = columns.begin() + starts[i + 1];
    const auto found = std::find(first, last, j);
    return found == last ? nullptr : &blocks[static_cast<std::size_t>(found - columns.begin())];
  }
};

}  // namespace comma::solver
