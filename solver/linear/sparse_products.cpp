#include "solver/linear/sparse_products.hpp"

#include <algorithm>

#include "solver/parallel.hpp"

namespace comma::solver {
namespace {

using SparseColumns = Eigen::SparseMatrix<double>;

/// Columns of a dense product that one part makes.
constexpr Eigen::Index part_columns = 64;

/// part(first, width) for all columns.
template <typename Part>
void by_columns(Eigen::Index columns, const Part& part) {
  run_parts(static_cast<int>((columns + part_columns - 1) / part_columns), [&](int number) {
    const Eigen::Index first = number * part_columns;
    part(first, std::min(part_columns, columns - first));
  });
}

}  // namespace

Eigen::MatrixXd product(const Eigen::MatrixXd& dense, const SparseColumns& sparse) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(dense.rows(), sparse.cols());
  by_columns(sparse.cols(), [&](Eigen::Index first, Eigen::Index width) {
    for (Eigen::Index column = first; column < first + width; ++column)
      for (SparseColumns::InnerIterator it(sparse, column); it; ++it)
        result.col(column) += it.value() * dense.col(it.row());
  });
  return result;
}

Eigen::MatrixXd product(const RowMatrix& sparse, const Eigen::MatrixXd& dense) {
  Eigen::MatrixXd result(sparse.rows(), dense.cols());
  by_columns(dense.cols(), [&](Eigen::Index first, Eigen::Index width) {
    result.middleCols(first, width) = sparse * dense.middleCols(first, width);
  });
  return result;
}

}  // namespace comma::solver
