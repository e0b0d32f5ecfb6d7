#include "solver/linear/supernodal_compliance.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/linear/dense_solve.hpp"

namespace comma::solver {
namespace {

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// What a subtree leaves to its ancestors: rows below it, of the conditions that it touches.
struct Contribution {
  std::vector<int> rows;        ///< places in L, rising
  std::vector<int> conditions;  ///< rising
  Eigen::MatrixXd values;       ///< rows x conditions
};

class SupernodalCompliance {
 public:
  SupernodalCompliance(const SupernodalFactor& factor, const BlasKernels& blas, const Rows& rows)
      : factor_(factor),
        blas_(blas),
        entries_(static_cast<std::size_t>(factor.count)),
        children_(static_cast<std::size_t>(factor.count)),
        row_places_(static_cast<std::size_t>(factor.size), -1),
        condition_places_(static_cast<std::size_t>(rows.rows()), -1),
        all_(static_cast<std::size_t>(rows.rows())),
        compliance_(Eigen::MatrixXd::Zero(rows.rows(), rows.rows())) {
    std::iota(all_.begin(), all_.end(), 0);
    supernodes_.resize(static_cast<std::size_t>(factor.size));
    for (int node = 0; node < factor.count; ++node)
      std::fill(supernodes_.begin() + factor.first_columns[node], supernodes_.begin() + factor.first_columns[node + 1], node);
    std::vector<int> places(static_cast<std::size_t>(factor.size));
    for (int place = 0; place < factor.size; ++place) places[factor.order[place]] = place;
    for (int row = 0; row < rows.outerSize(); ++row)
      for (Rows::InnerIterator it(rows, row); it; ++it) {
        const int place = places[it.col()];
        entries_[supernodes_[place]].emplace_back(place, row, it.value());
      }
  }

  Eigen::MatrixXd run() {
    for (int node = 0; node < factor_.count; ++node) eliminate(node);
    fill_upper(compliance_);
    return std::move(compliance_);
  }

 private:
  std::vector<int> conditions_of(int node) const {
    std::vector<int> conditions;
    for (const auto& entry : entries_[node]) conditions.push_back(static_cast<int>(entry.col()));
    std::sort(conditions.begin(), conditions.end());
    conditions.erase(std::unique(conditions.begin(), conditions.end()), conditions.end());
    for (const Contribution& child : children_[node]) {
      std::vector<int> merged;
      std::set_union(conditions.begin(), conditions.end(), child.conditions.begin(), child.conditions.end(), std::back_inserter(merged));
      conditions = std::move(merged);
    }
    return conditions;
  }

  void eliminate(int node) {
    std::vector<int> conditions = conditions_of(node);
    if (conditions.empty()) return;
    const int* first = factor_.rows + factor_.row_starts[node];
    const int* last = factor_.rows + factor_.row_starts[node + 1];
    const int columns = factor_.first_columns[node + 1] - factor_.first_columns[node];
    Eigen::MatrixXd front = assembled(node, {first, last}, conditions);
    solve(node, columns, front);
    add_square(columns, conditions, front);
    const auto below = front.rows() - columns;
    if (below == 0) return;
    children_[supernodes_[first[columns]]].push_back({{first + columns, last}, std::move(conditions), front.bottomRows(below)});
  }

  /// The supernode's own entries and what its children leave.
  Eigen::MatrixXd assembled(int node, const std::vector<int>& rows, const std::vector<int>& conditions) {
    for (std::size_t i = 0; i < rows.size(); ++i) row_places_[rows[i]] = static_cast<int>(i);
    for (std::size_t i = 0; i < conditions.size(); ++i) condition_places_[conditions[i]] = static_cast<int>(i);
    Eigen::MatrixXd front = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(conditions.size()));
    for (const auto& entry : entries_[node]) front(row_places_[entry.row()], condition_places_[entry.col()]) += entry.value();
    for (const Contribution& child : children_[node])
      for (std::size_t j = 0; j < child.conditions.size(); ++j) {
        auto target = front.col(condition_places_[child.conditions[j]]);
        for (std::size_t i = 0; i < child.rows.size(); ++i)
          target[row_places_[child.rows[i]]] += child.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    std::vector<Contribution>().swap(children_[node]);
    return front;
  }

  /// Y of the supernode's own rows takes their place; rows below lose what it accounts for.
  void solve(int node, int columns, Eigen::MatrixXd& front) const {
    const double* factor = factor_.values + factor_.value_starts[node];
    const int rows = static_cast<int>(front.rows()), count = static_cast<int>(front.cols()), below = rows - columns;
    const double plus = 1.0, minus = -1.0;
    blas_.solve("L", "L", "N", "N", &columns, &count, &plus, factor, &rows, front.data(), &rows);
    if (below > 0)
      blas_.multiply("N", "N", &below, &count, &columns, &minus, factor + columns, &rows, front.data(), &rows, &plus, front.data() + columns, &rows);
  }

  /// Y^T Y, lower triangle.
  void add_square(int columns, const std::vector<int>& conditions, const Eigen::MatrixXd& front) {
    const int count = static_cast<int>(front.cols()), rows = static_cast<int>(front.rows());
    const double one = 1.0, zero = 0.0;
    if (conditions.size() == all_.size()) {
      blas_.square("L", "T", &count, &columns, &one, front.data(), &rows, &one, compliance_.data(), &count);
      return;
    }
    Eigen::MatrixXd square(count, count);
    blas_.square("L", "T", &count, &columns, &one, front.data(), &rows, &zero, square.data(), &count);
    for (int j = 0; j < count; ++j)
      for (int i = j; i < count; ++i) compliance_(conditions[i], conditions[j]) += square(i, j);
  }

  const SupernodalFactor& factor_;
  const BlasKernels& blas_;
  std::vector<int> supernodes_;  ///< of each place
  std::vector<std::vector<Eigen::Triplet<double>>> entries_;  ///< (place, condition), by supernode
  std::vector<std::vector<Contribution>> children_;
  std::vector<int> row_places_, condition_places_;  ///< in the front at hand
  std::vector<int> all_;
  Eigen::MatrixXd compliance_;
};

}  // namespace

BlasKernels::BlasKernels(const SharedLibrary& library)
    : solve(library.function<Solve>("dtrsm_")), multiply(library.function<Multiply>("dgemm_")), square(library.function<Square>("dsyrk_")) {}

Eigen::MatrixXd supernodal_compliance(const SupernodalFactor& factor, const BlasKernels& blas, const Rows& rows) {
  return SupernodalCompliance(factor, blas, rows).run();
}

}  // namespace comma::solver
