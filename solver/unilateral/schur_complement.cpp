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

SchurComplement::SchurComplement(RowMatrix rows, ApplyInverse inverse, std::vector<int> support)
    : rows_(std::move(rows)),
      inverse_(std::move(inverse)),
      columns_(static_cast<std::size_t>(rows_.rows())),
      support_(std::move(support)),
      compliance_(support_.size()) {
  assert(std::is_sorted(support_.begin(), support_.end()));
  rows_.makeCompressed();
}

void SchurComplement::require(std::span<const int> indices) {
  std::vector<int> missing;
  for (const int index : indices)
    if (!known(index)) missing.push_back(index);
  if (missing.empty()) return;
  const bool keeps_compliance = rows_change_ && support_.size() <= largest_support;
  if (!keeps_compliance || !build_from_compliance(missing)) solve_rows(missing);
}

void SchurComplement::solve_rows(const std::vector<int>& missing) {
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

int SchurComplement::support_index(int unknown) const {
  const auto found = std::lower_bound(support_.begin(), support_.end(), unknown);
  return found != support_.end() && *found == unknown ? static_cast<int>(found - support_.begin()) : -1;
}

/// S = A C A^T; false when a row leaves the support.
bool SchurComplement::build_from_compliance(const std::vector<int>& missing) {
  std::vector<int> places(static_cast<std::size_t>(rows_.cols()), -1);
  for (Eigen::Index k = 0; k < rows_.nonZeros(); ++k) {
    const int unknown = rows_.innerIndexPtr()[k];
    if (places[unknown] < 0) places[unknown] = support_index(unknown);
    if (places[unknown] < 0) return false;
  }
  std::vector<int> unsolved;
  for (const int row : missing)
    for (RowMatrix::InnerIterator it(rows_, row); it; ++it)
      if (compliance_[places[it.col()]].size() == 0) unsolved.push_back(places[it.col()]);
  std::sort(unsolved.begin(), unsolved.end());
  unsolved.erase(std::unique(unsolved.begin(), unsolved.end()), unsolved.end());
  for (std::size_t first = 0; first < unsolved.size(); first += batch_size) {
    const std::size_t count = std::min<std::size_t>(batch_size, unsolved.size() - first);
    Eigen::MatrixXd batch = Eigen::MatrixXd::Zero(rows_.cols(), static_cast<Eigen::Index>(count));
    for (std::size_t k = 0; k < count; ++k) batch(support_[unsolved[first + k]], static_cast<Eigen::Index>(k)) = 1.0;
    inverse_(batch);
    for (std::size_t k = 0; k < count; ++k) compliance_[unsolved[first + k]] = batch(support_, static_cast<Eigen::Index>(k));
  }
  for (const int row : missing) {
    Eigen::VectorXd response = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(support_.size()));
    for (RowMatrix::InnerIterator it(rows_, row); it; ++it) response += it.value() * compliance_[places[it.col()]];
    Eigen::VectorXd column = Eigen::VectorXd::Zero(rows_.rows());
    for (int other = 0; other < rows_.outerSize(); ++other)
      for (RowMatrix::InnerIterator it(rows_, other); it; ++it) column[other] += it.value() * response[places[it.col()]];
    columns_[row] = std::move(column);
  }
  return true;
}

const Eigen::VectorXd& SchurComplement::column(int index) const {
  assert(known(index));
  return columns_[index];
}

void SchurComplement::replace_rows(RowMatrix rows) {
  rows.makeCompressed();
  if (same(rows_, rows)) return;
  rows_change_ = rows_change_ || rows_.rows() > 0;
  rows_ = std::move(rows);
  columns_.assign(static_cast<std::size_t>(rows_.rows()), Eigen::VectorXd());
}

void SchurComplement::forget() {
  columns_.assign(static_cast<std::size_t>(rows_.rows()), Eigen::VectorXd());
  compliance_.assign(support_.size(), Eigen::VectorXd());
}

}  // namespace comma::solver
