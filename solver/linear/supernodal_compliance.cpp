#include "solver/linear/supernodal_compliance.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/linear/dense_solve.hpp"

namespace comma::solver {
namespace {

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Where a body has so many times fewer unknowns that rows touch than it has such rows, these are combined from the
/// compliance of the unknowns: the side of a contact whose mesh is coarser.
constexpr double few_unknowns = 1.5;

std::vector<int> supernodes_of(const SupernodalFactor& factor) {
  std::vector<int> supernodes(static_cast<std::size_t>(factor.size));
  for (int node = 0; node < factor.count; ++node)
    std::fill(supernodes.begin() + factor.first_columns[node], supernodes.begin() + factor.first_columns[node + 1],
              node);
  return supernodes;
}

std::vector<int> places_of(const SupernodalFactor& factor) {
  std::vector<int> places(static_cast<std::size_t>(factor.size));
  for (int place = 0; place < factor.size; ++place) places[factor.order[place]] = place;
  return places;
}

/// What a subtree leaves to its ancestors: rows below it, of the conditions that it touches.
struct Contribution {
  std::vector<int> rows;        ///< places in L, rising
  std::vector<int> conditions;  ///< rising
  Eigen::MatrixXd values;       ///< rows x conditions
};

class SupernodalCompliance {
 public:
  /// Adds to the lower triangle of `compliance`.
  SupernodalCompliance(const SupernodalFactor& factor, const BlasKernels& blas, const Rows& rows,
                       Eigen::MatrixXd& compliance)
      : factor_(factor),
        blas_(blas),
        entries_(static_cast<std::size_t>(factor.count)),
        children_(static_cast<std::size_t>(factor.count)),
        row_places_(static_cast<std::size_t>(factor.size), -1),
        condition_places_(static_cast<std::size_t>(rows.rows()), -1),
        all_(static_cast<std::size_t>(rows.rows())),
        compliance_(compliance) {
    std::iota(all_.begin(), all_.end(), 0);
    supernodes_ = supernodes_of(factor);
    const std::vector<int> places = places_of(factor);
    for (int row = 0; row < rows.outerSize(); ++row)
      for (Rows::InnerIterator it(rows, row); it; ++it) {
        const int place = places[it.col()];
        entries_[supernodes_[place]].emplace_back(place, row, it.value());
      }
  }

  void run() {
    for (int node = 0; node < factor_.count; ++node) eliminate(node);
  }

 private:
  std::vector<int> conditions_of(int node) const {
    std::vector<int> conditions;
    for (const auto& entry : entries_[node]) conditions.push_back(static_cast<int>(entry.col()));
    std::sort(conditions.begin(), conditions.end());
    conditions.erase(std::unique(conditions.begin(), conditions.end()), conditions.end());
    for (const Contribution& child : children_[node]) {
      std::vector<int> merged;
      std::set_union(conditions.begin(), conditions.end(), child.conditions.begin(), child.conditions.end(),
                     std::back_inserter(merged));
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
    children_[supernodes_[first[columns]]].push_back(
        {{first + columns, last}, std::move(conditions), front.bottomRows(below)});
  }

  /// The supernode's own entries and what its children leave.
  Eigen::MatrixXd assembled(int node, const std::vector<int>& rows, const std::vector<int>& conditions) {
    for (std::size_t i = 0; i < rows.size(); ++i) row_places_[rows[i]] = static_cast<int>(i);
    for (std::size_t i = 0; i < conditions.size(); ++i) condition_places_[conditions[i]] = static_cast<int>(i);
    Eigen::MatrixXd front =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(conditions.size()));
    for (const auto& entry : entries_[node])
      front(row_places_[entry.row()], condition_places_[entry.col()]) += entry.value();
    for (const Contribution& child : children_[node])
      for (std::size_t j = 0; j < child.conditions.size(); ++j) {
        auto target = front.col(condition_places_[child.conditions[j]]);
        for (std::size_t i = 0; i < child.rows.size(); ++i)
          target[row_places_[child.rows[i]]] +=
              child.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
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
      blas_.multiply("N", "N", &below, &count, &columns, &minus, factor + columns, &rows, front.data(), &rows, &plus,
                     front.data() + columns, &rows);
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
  std::vector<int> supernodes_;                               ///< of each place
  std::vector<std::vector<Eigen::Triplet<double>>> entries_;  ///< (place, condition), by supernode
  std::vector<std::vector<Contribution>> children_;
  std::vector<int> row_places_, condition_places_;  ///< in the front at hand
  std::vector<int> all_;
  Eigen::MatrixXd& compliance_;
};

/// The tree of each unknown: those of bodies that nothing connects are different ones.
std::vector<int> trees_of(const SupernodalFactor& factor) {
  const std::vector<int> supernodes = supernodes_of(factor);
  std::vector<int> roots(static_cast<std::size_t>(factor.count));
  for (int node = factor.count - 1; node >= 0; --node) {
    const int below = factor.row_starts[node] + factor.first_columns[node + 1] - factor.first_columns[node];
    roots[node] = below < factor.row_starts[node + 1] ? roots[supernodes[factor.rows[below]]] : node;
  }
  std::vector<int> trees(static_cast<std::size_t>(factor.size));
  for (int place = 0; place < factor.size; ++place) trees[factor.order[place]] = roots[supernodes[place]];
  return trees;
}

/// What rows have of the unknowns of one tree.
struct Part {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> unknowns;  ///< rising
  int rows = 0;               ///< that have any
};

std::map<int, Part> parts_of(const SupernodalFactor& factor, const Rows& rows) {
  const std::vector<int> trees = trees_of(factor);
  std::map<int, Part> parts;
  for (int row = 0; row < rows.outerSize(); ++row)
    for (Rows::InnerIterator it(rows, row); it; ++it) {
      Part& part = parts[trees[it.col()]];
      if (part.entries.empty() || part.entries.back().row() != row) ++part.rows;
      part.entries.emplace_back(row, static_cast<int>(it.col()), it.value());
      part.unknowns.push_back(static_cast<int>(it.col()));
    }
  for (auto& [tree, part] : parts) {
    std::ranges::sort(part.unknowns);
    part.unknowns.erase(std::unique(part.unknowns.begin(), part.unknowns.end()), part.unknowns.end());
  }
  return parts;
}

Rows matrix_of(const std::vector<Eigen::Triplet<double>>& entries, Eigen::Index rows, Eigen::Index columns) {
  Rows result(rows, columns);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// By the compliance of the unknowns themselves: rows C rows^T.
void add_by_unknowns(const SupernodalFactor& factor, const BlasKernels& blas, const Part& part,
                     Eigen::MatrixXd& compliance) {
  const auto count = static_cast<Eigen::Index>(part.unknowns.size());
  std::vector<Eigen::Triplet<double>> units, entries;
  for (Eigen::Index k = 0; k < count; ++k)
    units.emplace_back(static_cast<int>(k), part.unknowns[static_cast<std::size_t>(k)], 1.0);
  for (const auto& entry : part.entries)
    entries.emplace_back(entry.row(),
                         static_cast<int>(std::ranges::lower_bound(part.unknowns, entry.col()) - part.unknowns.begin()),
                         entry.value());
  Eigen::MatrixXd between = Eigen::MatrixXd::Zero(count, count);
  SupernodalCompliance(factor, blas, matrix_of(units, count, factor.size), between).run();
  fill_upper(between);
  const Rows rows = matrix_of(entries, compliance.rows(), count);
  Eigen::VectorXd moved(count);
  for (int column = 0; column < rows.outerSize(); ++column) {
    moved.setZero();
    for (Rows::InnerIterator it(rows, column); it; ++it) moved += it.value() * between.col(it.col());
    const auto below = rows.rows() - column;
    compliance.col(column).tail(below) += rows.bottomRows(below) * moved;
  }
}

}  // namespace

BlasKernels::BlasKernels(const SharedLibrary& library)
    : solve(library.function<Solve>("dtrsm_")),
      multiply(library.function<Multiply>("dgemm_")),
      square(library.function<Square>("dsyrk_")) {}

Eigen::MatrixXd supernodal_compliance(const SupernodalFactor& factor, const BlasKernels& blas, const Rows& rows) {
  Eigen::MatrixXd compliance(rows.rows(), rows.rows());
  compliance.setZero();
  for (const auto& [tree, part] : parts_of(factor, rows)) {
    if (few_unknowns * static_cast<double>(part.unknowns.size()) < part.rows)
      add_by_unknowns(factor, blas, part, compliance);
    else
      SupernodalCompliance(factor, blas, matrix_of(part.entries, rows.rows(), rows.cols()), compliance).run();
  }
  fill_upper(compliance);
  return compliance;
}

}  // namespace comma::solver
