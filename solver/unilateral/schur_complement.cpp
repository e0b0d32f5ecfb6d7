#include "solver/unilateral/schur_complement.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace comma::solver {
namespace {

bool same(const RowMatrix& a, const RowMatrix& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols() || a.nonZeros() != b.nonZeros()) return false;
  return std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()) &&
         std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr());
}

}  // namespace

SchurComplement::SchurComplement(RowMatrix rows, ApplyInverse inverse)
    : rows_(std::move(rows)), inverse_(std::move(inverse)), columns_(static_cast<std::size_t>(rows_.rows())) {
  rows_.makeCompressed();
}

void SchurComplement::require(std::span<const int> indices) {
  std::vector<int> missing;
  for (const int index : indices)
    if (!known(index)) missing.push_back(index);
  for (std::size_t first = 0; first < missing.size(); first += batch_size) {
    const std::size_t count = std::min<std::size_t>(batch_size, missing.size() - first);
    Eigen::MatrixXd batch = Eigen::MatrixXd::Zero(rows_.cols(), static_cast<Eigen::Index>(count));
    for (std::size_t k = 0; k < count; ++k)
      for (RowMatrix::InnerIterator it(rows_, missing[first + k]); it; ++it)
        batch(it.col(), static_cast<Eigen::Index>(k)) = it.value();
    inverse_(batch);
    const Eigen::MatrixXd product = rows_ * batch;
    for (std::size_t k = 0; k < count; ++k) columns_[missing[first + k]] = product.col(static_cast<Eigen::Index>(k));
  }
}

const Eigen::VectorXd& SchurComplement::column(int index) const {
  assert(known(index));
  return columns_[index];
}

void SchurComplement::replace_rows(RowMatrix rows) {
  rows.makeCompressed();
  if (same(rows_, rows)) return;
  rows_ = std::move(rows);
  forget();
}

void SchurComplement::forget() { columns_.assign(static_cast<std::size_t>(rows_.rows()), Eigen::VectorXd()); }

}  // namespace comma::solver
