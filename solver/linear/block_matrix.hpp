// Sparse matrices of small dense blocks, by rows: what multigrid works on.
#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Dense>

#include "solver/parallel.hpp"

namespace comma::solver {

/// Blocks of R x C; those of block row i are numbers starts[i] .. starts[i + 1] - 1, their block columns in `columns`.
template <int R, int C>
struct BlockMatrix {
  using Block = Eigen::Matrix<double, R, C>;

  /// Fewer rows are done before another thread has begun.
  static constexpr int divided_rows = 4000;
  static constexpr int most_parts = 4;

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

  /// The same, x being taken from `x` in the block columns first .. last - 1 and from `elsewhere` in the others.
  Eigen::Matrix<double, R, 1> row_times(int i, const Eigen::VectorXd& x, const Eigen::VectorXd& elsewhere, int first,
                                        int last) const {
    Eigen::Matrix<double, R, 1> sum = Eigen::Matrix<double, R, 1>::Zero();
    for (int k = starts[i]; k < starts[i + 1]; ++k) {
      const bool inside = columns[k] >= first && columns[k] < last;
      sum.noalias() +=
          blocks[k] * (inside ? x : elsewhere).template segment<C>(static_cast<Eigen::Index>(columns[k]) * C);
    }
    return sum;
  }

  /// How many parts its rows are worked on in: as many whatever the machine has.
  int part_count() const { return rows() < divided_rows ? 1 : most_parts; }
  /// The first row of a part.
  int part_start(int part) const { return static_cast<int>(static_cast<long>(rows()) * part / part_count()); }

  /// y = A x.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
    run_parts(part_count(), [&](int part) {
      for (int i = part_start(part); i < part_start(part + 1); ++i)
        y.segment<R>(static_cast<Eigen::Index>(i) * R) = row_times(i, x);
    });
  }

  /// y += A^T x.
  void add_transposed(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
    std::vector<Eigen::VectorXd> sums(static_cast<std::size_t>(part_count()), Eigen::VectorXd::Zero(y.size()));
    run_parts(part_count(), [&](int part) {
      Eigen::VectorXd& sum = sums[static_cast<std::size_t>(part)];
      for (int i = part_start(part); i < part_start(part + 1); ++i) {
        const Eigen::Matrix<double, R, 1> segment = x.segment<R>(static_cast<Eigen::Index>(i) * R);
        for (int k = starts[i]; k < starts[i + 1]; ++k)
          sum.segment<C>(static_cast<Eigen::Index>(columns[k]) * C).noalias() += blocks[k].transpose() * segment;
      }
    });
    for (const Eigen::VectorXd& sum : sums) y += sum;
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
