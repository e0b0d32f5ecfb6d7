#include "solver/constraints/congruence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace comma::solver {

namespace {

using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// What is left of contributions that cancel, as those of a body that relations make rigid do, is nothing: a pivot of
/// it would hold the body.
constexpr double nothing_left = 1e-13;

struct WeightedRow {
  int row;
  int source;
  double weight;
};

/// Calls place(row, column, source, weight) for every contribution to the lower triangle of T^T K T.
template <typename Place>
void for_each_contribution(const SymmetricMatrix& pattern, const RowMajor& transformation, Place&& place) {
  for (int j = 0; j < pattern.outerSize(); ++j) {
    for (int source = pattern.outerIndexPtr()[j]; source < pattern.outerIndexPtr()[j + 1]; ++source) {
      const int i = pattern.innerIndexPtr()[source];
      for (RowMajor::InnerIterator a(transformation, i); a; ++a) {
        for (RowMajor::InnerIterator b(transformation, j); b; ++b) {
          const int row = static_cast<int>(a.col());
          const int column = static_cast<int>(b.col());
          if (i == j && row < column) continue;
          // K_ij and its mirror image meet on the product's diagonal.
          const double factor = i != j && row == column ? 2.0 : 1.0;
          place(std::max(row, column), std::min(row, column), source, factor * a.value() * b.value());
        }
      }
    }
  }
}

std::vector<int> count_by_column(const SymmetricMatrix& pattern, const RowMajor& transformation) {
  std::vector<int> starts(transformation.cols() + 1, 0);
  for_each_contribution(pattern, transformation, [&](int, int column, int, double) { ++starts[column + 1]; });
  for (std::size_t column = 1; column < starts.size(); ++column) starts[column] += starts[column - 1];
  return starts;
}

double contribution_count(const SymmetricMatrix& pattern, const RowMajor& transformation) {
  const auto width = [&](int row) {
    return static_cast<double>(transformation.outerIndexPtr()[row + 1] - transformation.outerIndexPtr()[row]);
  };
  double count = 0.0;
  for (int j = 0; j < pattern.outerSize(); ++j)
    for (SymmetricMatrix::InnerIterator it(pattern, j); it; ++it) count += width(static_cast<int>(it.row())) * width(j);
  return count;
}

}  // namespace

Congruence::Congruence(const SymmetricMatrix& pattern, const Eigen::SparseMatrix<double>& transformation, double most)
    : outer_(pattern.outerIndexPtr(), pattern.outerIndexPtr() + pattern.outerSize() + 1),
      inner_(pattern.innerIndexPtr(), pattern.innerIndexPtr() + pattern.nonZeros()) {
  const RowMajor by_rows = transformation;
  constexpr double many_each = 4.0;  // to an entry of K; with fewer the list takes less memory than whole matrices
  const double count = contribution_count(pattern, by_rows);
  if (count > most && count > many_each * static_cast<double>(pattern.nonZeros())) {
    transformation_ = transformation;
    return;
  }
  const std::vector<int> starts = count_by_column(pattern, by_rows);
  std::vector<WeightedRow> contributions(starts.back());
  std::vector<int> next(starts.begin(), starts.end() - 1);
  bool all_ones = true;
  for_each_contribution(pattern, by_rows, [&](int row, int column, int source, double weight) {
    contributions[next[column]++] = {row, source, weight};
    all_ones = all_ones && weight == 1.0;
  });

  const int columns = static_cast<int>(transformation.cols());
  std::vector<int> outer = {0};
  std::vector<int> inner;
  // Memory that grows by doubling is written twice.
  inner.reserve(contributions.size());
  targets_.reserve(contributions.size());
  sources_.reserve(contributions.size());
  if (!all_ones) weights_.reserve(contributions.size());
  for (int column = 0; column < columns; ++column) {
    const auto first = contributions.begin() + starts[column];
    const auto last = contributions.begin() + starts[column + 1];
    std::stable_sort(first, last, [](const auto& a, const auto& b) { return a.row < b.row; });
    for (auto entry = first; entry != last; ++entry) {
      if (entry == first || entry->row != (entry - 1)->row) inner.push_back(entry->row);
      targets_.push_back(static_cast<int>(inner.size()) - 1);
      sources_.push_back(entry->source);
      if (!all_ones) weights_.push_back(entry->weight);
    }
    outer.push_back(static_cast<int>(inner.size()));
  }
  std::vector<WeightedRow>().swap(contributions);
  const std::vector<double> zeros(inner.size(), 0.0);
  product_ = Eigen::Map<const SymmetricMatrix>(columns, columns, static_cast<Eigen::Index>(inner.size()), outer.data(),
                                               inner.data(), zeros.data());
}

bool Congruence::fits(const SymmetricMatrix& matrix) const {
  return matrix.outerSize() + 1 == static_cast<Eigen::Index>(outer_.size()) &&
         matrix.nonZeros() == static_cast<Eigen::Index>(inner_.size()) &&
         std::equal(outer_.begin(), outer_.end(), matrix.outerIndexPtr()) &&
         std::equal(inner_.begin(), inner_.end(), matrix.innerIndexPtr());
}

SymmetricMatrix Congruence::apply(const SymmetricMatrix& matrix) const {
  if (transformation_.size() > 0) {
    const Eigen::SparseMatrix<double> whole = matrix.selfadjointView<Eigen::Lower>();
    const Eigen::SparseMatrix<double> moved = whole * transformation_;
    const Eigen::SparseMatrix<double> product = Eigen::SparseMatrix<double>(transformation_.transpose()) * moved;
    return product.triangularView<Eigen::Lower>();
  }
  SymmetricMatrix result = product_;
  const double* from = matrix.valuePtr();
  double* to = result.valuePtr();
  const auto weight = [&](std::size_t k) { return weights_.empty() ? 1.0 : weights_[k]; };
  if (targets_.size() == static_cast<std::size_t>(result.nonZeros())) {
    for (std::size_t k = 0; k < sources_.size(); ++k) to[targets_[k]] = weight(k) * from[sources_[k]];
    return result;
  }
  struct Sum {
    long double value = 0.0L;
    double size = 0.0;
  };
  // In extended precision translations, over which rows add up to exactly zero, leave nothing beside what really holds
  // a rigid body.
  std::vector<Sum> sums(static_cast<std::size_t>(result.nonZeros()));
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    Sum& sum = sums[static_cast<std::size_t>(targets_[k])];
    const long double part = static_cast<long double>(weight(k)) * from[sources_[k]];
    sum.value += part;
    sum.size += std::abs(static_cast<double>(part));
  }
  for (std::size_t entry = 0; entry < sums.size(); ++entry)
    if (std::abs(sums[entry].value) > nothing_left * sums[entry].size)
      to[entry] = static_cast<double>(sums[entry].value);
  return result;
}

}  // namespace comma::solver
