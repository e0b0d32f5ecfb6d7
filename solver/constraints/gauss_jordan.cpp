#include "solver/constraints/gauss_jordan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace comma::solver {

namespace {

/// A sparse row under construction: dense values with a list of the places touched.
class Accumulator {
 public:
  explicit Accumulator(int size) : values_(size, 0.0), sizes_(size, 0.0), touched_flag_(size, 0) {}

  void add(const SparseRow& row, double factor) {
    for (const auto& [index, coefficient] : row) add(index, factor * coefficient);
  }

  void add(int index, double term) {
    if (!touched_flag_[index]) {
      touched_flag_[index] = 1;
      touched_.push_back(index);
    }
    values_[index] += term;
    sizes_[index] = std::max(sizes_[index], std::abs(term));
  }

  void erase(int index) { values_[index] = 0.0; }

  /// The row, rounding left out; empties the accumulator.
  SparseRow take() {
    std::sort(touched_.begin(), touched_.end());
    SparseRow row;
    for (const int index : touched_) {
      if (std::abs(values_[index]) > cancellation_tolerance * sizes_[index]) row.emplace_back(index, values_[index]);
      values_[index] = sizes_[index] = 0.0;
      touched_flag_[index] = 0;
    }
    touched_.clear();
    return row;
  }

 private:
  std::vector<double> values_;
  std::vector<double> sizes_;  ///< the largest term added to each
  std::vector<char> touched_flag_;
  std::vector<int> touched_;
};

double largest_of(const SparseRow& row) {
  double largest = 0.0;
  for (const auto& term : row) largest = std::max(largest, std::abs(term.second));
  return largest;
}

double smallest_of(const SparseRow& row) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& term : row) smallest = std::min(smallest, std::abs(term.second));
  return smallest;
}

double coefficient_of(const SparseRow& row, int index) {
  const auto at =
      std::lower_bound(row.begin(), row.end(), index, [](const auto& term, int i) { return term.first < i; });
  return at != row.end() && at->first == index ? at->second : 0.0;
}

void scale(SparseRow& row, double factor) {
  for (auto& term : row) term.second *= factor;
}

class Reduction {
 public:
  Reduction(std::span<const SparseRow> relations, int columns)
      : relations_(relations),
        row_of_pivot_(columns, -1),
        appearances_(columns, 0),
        users_(columns),
        terms_(columns),
        combination_(static_cast<int>(relations.size())) {
    for (const SparseRow& relation : relations) {
      for (const auto& term : relation) ++appearances_[term.first];
    }
  }

  GaussJordan run() {
    std::vector<int> order(relations_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [this](int a, int b) { return relations_[a].size() < relations_[b].size(); });
    for (const int relation : order) eliminate(relation);
    return std::move(result_);
  }

 private:
  void eliminate(int relation) {
    combination_.add(relation, 1.0);
    for (const auto& [column, coefficient] : relations_[relation]) substitute(column, coefficient);
    SparseRow terms = terms_.take();
    SparseRow combination = combination_.take();
    // What is left may also be the rounding of rows that were substituted: it is tiny beside everything that was
    // written.
    if (terms.empty() || largest_of(terms) <= cancellation_tolerance * smallest_of(relations_[relation])) {
      result_.dependencies.push_back(std::move(combination));
      return;
    }
    const int pivot = choose_pivot(terms);
    const double inverse = 1.0 / coefficient_of(terms, pivot);
    scale(terms, inverse);
    scale(combination, inverse);
    std::erase_if(terms, [pivot](const auto& term) { return term.first == pivot; });
    add_row({pivot, std::move(terms), std::move(combination)});
  }

  /// Adds a term to the row under construction, or what the pivot row of its column says instead.
  void substitute(int column, double coefficient) {
    const int row = row_of_pivot_[column];
    terms_.add(column, coefficient);
    if (row < 0) return;
    terms_.erase(column);
    terms_.add(result_.rows[row].others, -coefficient);
    combination_.add(result_.rows[row].combination, -coefficient);
  }

  int choose_pivot(const SparseRow& terms) const {
    const double largest = largest_of(terms);
    int best = -1;
    for (const auto& [column, coefficient] : terms) {
      if (std::abs(coefficient) < largest * (1.0 - pivot_tie_tolerance)) continue;
      if (best < 0 || appearances_[column] < appearances_[best]) best = column;
    }
    return best;
  }

  void add_row(GaussJordan::Row row) {
    for (const int user : users_[row.pivot]) clear_column(user, row);
    users_[row.pivot].clear();
    const int index = static_cast<int>(result_.rows.size());
    row_of_pivot_[row.pivot] = index;
    for (const auto& term : row.others) users_[term.first].push_back(index);
    result_.rows.push_back(std::move(row));
  }

  /// Replaces the new pivot's column in an earlier row.
  void clear_column(int index, const GaussJordan::Row& pivot_row) {
    GaussJordan::Row& row = result_.rows[index];
    const double coefficient = coefficient_of(row.others, pivot_row.pivot);
    if (coefficient == 0.0) return;
    terms_.add(row.others, 1.0);
    terms_.erase(pivot_row.pivot);
    terms_.add(pivot_row.others, -coefficient);
    combination_.add(row.combination, 1.0);
    combination_.add(pivot_row.combination, -coefficient);
    for (const auto& term : pivot_row.others) {
      if (coefficient_of(row.others, term.first) == 0.0) users_[term.first].push_back(index);
    }
    row.others = terms_.take();
    row.combination = combination_.take();
  }

  std::span<const SparseRow> relations_;
  std::vector<int> row_of_pivot_;
  std::vector<int> appearances_;
  std::vector<std::vector<int>> users_;  ///< rows whose `others` hold a column (or held it once)
  Accumulator terms_;
  Accumulator combination_;
  GaussJordan result_;
};

}  // namespace

GaussJordan gauss_jordan(std::span<const SparseRow> relations, int columns) {
  return Reduction(relations, columns).run();
}

}  // namespace comma::solver
