#include "solver/unilateral/schur_complement.hpp"

#include <algorithm>
#include <cassert>
#include <unordered_map>
#include <utility>

#include "solver/linear/sparse_products.hpp"

namespace comma::solver {
namespace {

using SparseColumns = Eigen::SparseMatrix<double>;

}  // namespace

SchurComplement::SchurComplement(RowMatrix rows, ApplyInverse inverse, std::vector<int> support, std::vector<int> keys)
    : rows_(std::move(rows)),
      keys_(std::move(keys)),
      inverse_(std::move(inverse)),
      columns_(static_cast<std::size_t>(rows_.rows())),
      support_(std::move(support)),
      compliance_(support_.size()) {
  assert(std::is_sorted(support_.begin(), support_.end()));
  rows_.makeCompressed();
  source_ = rows_;
  choose_form();
}

/// Rows that leave the support are multiplied out.
void SchurComplement::choose_form() {
  is_factored_ = false;
  on_support_.resize(0, 0);
  if (rows_.rows() < factored_rows || support_.size() > largest_factor ||
      static_cast<double>(rows_.rows()) < factored_share * static_cast<double>(support_.size()))
    return;
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < rows_.outerSize(); ++row)
    for (RowMatrix::InnerIterator it(rows_, row); it; ++it) {
      const int place = support_index(static_cast<int>(it.col()));
      if (place < 0) return;
      entries.emplace_back(row, place, it.value());
    }
  is_factored_ = true;
  on_support_.resize(rows_.rows(), static_cast<Eigen::Index>(support_.size()));
  on_support_.setFromTriplets(entries.begin(), entries.end());
}

void SchurComplement::solve_factor() {
  clear();
  const auto count = static_cast<Eigen::Index>(support_.size());
  RowMatrix units(count, rows_.cols());
  for (Eigen::Index k = 0; k < count; ++k) units.insert(k, support_[static_cast<std::size_t>(k)]) = 1.0;
  if (whole_) factor_ = whole_(units);
  if (factor_.size() == 0) {
    Eigen::MatrixXd factor(count, count);
    for (Eigen::Index first = 0; first < count; first += batch_size) {
      const Eigen::Index width = std::min<Eigen::Index>(batch_size, count - first);
      Eigen::MatrixXd batch = Eigen::MatrixXd(units.middleRows(first, width).transpose());
      inverse_(batch);
      factor.middleCols(first, width) = units * batch;
    }
    factor_ = std::move(factor);
  }
  exact_ = true;
}

/// A few columns of many unknowns take less than the factor.
bool SchurComplement::prefers_columns(std::span<const int> indices) const {
  if (keeps_compliance()) return false;
  std::size_t wanted = 0;
  for (std::size_t row = 0; row < columns_.size(); ++row) wanted += columns_[row].size() != 0;
  for (const int index : indices) wanted += columns_[static_cast<std::size_t>(index)].size() == 0;
  return static_cast<double>(wanted) < few_columns * static_cast<double>(support_.size());
}

Eigen::VectorXd SchurComplement::times_factors(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd forces = on_support_.transpose() * x;
  Eigen::VectorXd result = on_support_ * symmetric_product(factor_, forces);
  if (softness_.size()) result += softness_.cwiseProduct(x);
  return result;
}

Eigen::VectorXd SchurComplement::column_of_factors(int row) const {
  Eigen::VectorXd response = Eigen::VectorXd::Zero(factor_.rows());
  for (RowMatrix::InnerIterator it(on_support_, row); it; ++it) response += it.value() * factor_.col(it.col());
  Eigen::VectorXd column = on_support_ * response;
  if (softness_.size()) column[row] += softness_[row];
  return column;
}

Eigen::VectorXd Responses::operator*(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd moved = moved_ * x;
  if (!has_factors()) return moved;
  return rows_ * moved + own_ * x;
}

Eigen::MatrixXd Responses::weighed_by(const SparseColumns& weights) const {
  if (!has_factors()) return product(weights, moved_);
  Eigen::MatrixXd result = product(RowMatrix(RowMatrix(weights) * rows_), moved_);
  result += weights * own_;
  return result;
}

Eigen::MatrixXd Responses::whole() const {
  if (!has_factors()) return moved_;
  Eigen::MatrixXd result = product(rows_, moved_);
  result += own_;
  return result;
}

RowMatrix SchurComplement::on_support(const std::vector<int>& rows) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (RowMatrix::InnerIterator it(on_support_, rows[k]); it; ++it)
      entries.emplace_back(static_cast<int>(k), static_cast<int>(it.col()), it.value());
  RowMatrix taken(static_cast<Eigen::Index>(rows.size()), on_support_.cols());
  taken.setFromTriplets(entries.begin(), entries.end());
  return taken;
}

Responses SchurComplement::responses(const std::vector<int>& rows, const SparseColumns& forces) const {
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (has_factors()) {
    Eigen::VectorXd own = Eigen::VectorXd::Zero(count);
    for (Eigen::Index k = 0; k < count && softness_.size(); ++k) own[k] = softness_[rows[static_cast<std::size_t>(k)]];
    RowMatrix taken = on_support(rows);
    const SparseColumns moving = SparseColumns(taken.transpose()) * forces;
    return {std::move(taken), product(factor_, moving), own.asDiagonal() * forces};
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count, forces.cols());
  const bool is_whole = count == size() && std::ranges::is_sorted(rows);
  for (Eigen::Index unknown = 0; unknown < forces.cols(); ++unknown)
    for (SparseColumns::InnerIterator force(forces, unknown); force; ++force) {
      const Column column = this->column(rows[static_cast<std::size_t>(force.row())]);
      if (is_whole)
        result.col(unknown) += force.value() * column;
      else
        for (Eigen::Index k = 0; k < count; ++k)
          result(k, unknown) += force.value() * column[rows[static_cast<std::size_t>(k)]];
    }
  return Responses(std::move(result));
}

bool SchurComplement::has_columns() const {
  return has_factors() || whole_matrix_.size() != 0 ||
         std::ranges::any_of(columns_, [](const Eigen::VectorXd& column) { return column.size() != 0; });
}

void SchurComplement::require(std::span<const int> indices) {
  if (has_factors() || indices.empty()) return;
  if (is_factored_ && !prefers_columns(indices)) {
    solve_factor();
    return;
  }
  std::vector<int> missing;
  for (const int index : indices)
    if (!known(index)) missing.push_back(index);
  if (missing.empty() || (rows_change_ && keeps_compliance() && build_from_compliance(missing)) || solve_whole(missing))
    return;
  solve_rows(missing);
}

void SchurComplement::store(int row, Eigen::VectorXd column) {
  if (softness_.size()) column[row] += softness_[row];
  if (whole_matrix_.size())
    whole_matrix_.col(row) = column;
  else
    columns_[row] = std::move(column);
}

void SchurComplement::solve_rows(const std::vector<int>& missing) {
  for (std::size_t first = 0; first < missing.size(); first += batch_size) {
    const std::size_t count = std::min<std::size_t>(batch_size, missing.size() - first);
    Eigen::MatrixXd batch = Eigen::MatrixXd::Zero(rows_.cols(), static_cast<Eigen::Index>(count));
    for (std::size_t k = 0; k < count; ++k)
      for (RowMatrix::InnerIterator it(source_, missing[first + k]); it; ++it)
        batch(it.col(), static_cast<Eigen::Index>(k)) = it.value();
    inverse_(batch);
    const Eigen::MatrixXd product = source_ * batch;
    for (std::size_t k = 0; k < count; ++k) store(missing[first + k], product.col(static_cast<Eigen::Index>(k)));
  }
}

bool SchurComplement::solve_whole(const std::vector<int>& missing) {
  if (!whole_ || is_factored_ || missing.size() < many_columns ||
      static_cast<double>(missing.size()) < many_share * size())
    return false;
  single_ = {};
  whole_matrix_ = whole_(rows_);
  if (whole_matrix_.size() == 0) return false;
  columns_.assign(columns_.size(), Eigen::VectorXd());
  if (softness_.size()) whole_matrix_.diagonal() += softness_;
  source_ = rows_;
  exact_ = true;
  most_left_.reset();
  ++version_;
  return true;
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
    for (std::size_t k = 0; k < count; ++k)
      compliance_[unsolved[first + k]] = batch(support_, static_cast<Eigen::Index>(k));
  }
  for (const int row : missing) {
    Eigen::VectorXd response = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(support_.size()));
    for (RowMatrix::InnerIterator it(rows_, row); it; ++it) response += it.value() * compliance_[places[it.col()]];
    Eigen::VectorXd column = Eigen::VectorXd::Zero(rows_.rows());
    for (int other = 0; other < rows_.outerSize(); ++other)
      for (RowMatrix::InnerIterator it(rows_, other); it; ++it)
        column[other] += it.value() * response[places[it.col()]];
    store(row, std::move(column));
  }
  return true;
}

SchurComplement::Column SchurComplement::column(int index) const {
  assert(known(index));
  if (has_factors() && columns_[index].size() == 0) columns_[index] = column_of_factors(index);
  const double* first = whole_matrix_.size() ? whole_matrix_.col(index).data() : columns_[index].data();
  return {first, size()};
}

double SchurComplement::own(int index) const {
  if (!has_factors()) return column(index)[index];
  double sum = softness_.size() ? softness_[index] : 0.0;
  for (RowMatrix::InnerIterator one(on_support_, index); one; ++one)
    for (RowMatrix::InnerIterator other(on_support_, index); other; ++other)
      sum += one.value() * factor_(one.col(), other.col()) * other.value();
  return sum;
}

Eigen::Map<Eigen::VectorXd> SchurComplement::entries(int row) {
  return {whole_matrix_.size() ? whole_matrix_.col(row).data() : columns_[row].data(),
          static_cast<Eigen::Index>(columns_.size())};
}

Eigen::VectorXd SchurComplement::times(const Eigen::VectorXd& x) {
  std::vector<int> taken;
  for (int row = 0; row < size(); ++row)
    if (x[row] != 0.0) taken.push_back(row);
  require(taken);
  if (has_factors()) return times_factors(x);
  if (whole_matrix_.size() && static_cast<double>(taken.size()) >= many_share * size())
    return symmetric_product(whole_matrix_, x);
  Eigen::VectorXd product = Eigen::VectorXd::Zero(size());
  for (const int row : taken) product += x[row] * column(row);
  return product;
}

Eigen::VectorXd SchurComplement::times_roughly(const Eigen::VectorXd& x) {
  if (whole_matrix_.rows() < many_products) return times(x);
  if (single_.size() == 0) single_ = SingleTriangle(whole_matrix_);
  return single_ * x;
}

Eigen::VectorXd SchurComplement::times_roughly(const std::vector<int>& rows, const Eigen::VectorXd& x) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(size());
  all(rows) = x;
  return times_roughly(all)(rows);
}

void SchurComplement::replace_rows(RowMatrix rows, std::vector<int> keys, Eigen::VectorXd softness) {
  rows.makeCompressed();
  softness_ = std::move(softness);
  if (same_matrix(rows_, rows) && keys_ == keys) return;
  rows_change_ = rows_change_ || rows_.rows() > 0;
  if (has_factors() && replace_factored_rows(rows, keys)) return;
  const bool same_keys = keys_ == keys && rows_.rows() == rows.rows();
  const bool taken = !keeps_compliance() && has_columns() && (same_keys || take_over(rows, keys));
  rows_ = std::move(rows);
  keys_ = std::move(keys);
  exact_ = !taken;
  if (!taken) clear();
  choose_form();
}

/// The compliance of the support does not change with the rows. False where these are not to be factored any more.
bool SchurComplement::replace_factored_rows(RowMatrix& rows, std::vector<int>& keys) {
  std::swap(rows_, rows);
  choose_form();
  if (!is_factored_) {
    std::swap(rows_, rows);
    factor_.resize(0, 0);
    return false;
  }
  keys_ = std::move(keys);
  clear();
  return true;
}

void SchurComplement::clear() {
  ++version_;
  most_left_.reset();
  source_ = rows_;
  columns_.assign(static_cast<std::size_t>(rows_.rows()), Eigen::VectorXd());
  whole_matrix_.resize(0, 0);
  single_ = {};
}

/// Rows that stay keep their columns. False where half of them are new.
bool SchurComplement::take_over(const RowMatrix& rows, const std::vector<int>& keys) {
  std::unordered_map<int, int> earlier;
  for (int row = 0; row < size(); ++row) earlier.emplace(keys_.empty() ? row : keys_[row], row);
  const int count = static_cast<int>(rows.rows());
  std::vector<int> origin(static_cast<std::size_t>(count), -1);
  std::vector<int> added;
  for (int row = 0; row < count; ++row) {
    const auto found = earlier.find(keys.empty() ? row : keys[row]);
    if (found == earlier.end())
      added.push_back(row);
    else
      origin[row] = found->second;
  }
  if (2 * added.size() > static_cast<std::size_t>(count)) return false;

  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < count; ++row) {
    const bool stays = origin[row] >= 0;
    for (RowMatrix::InnerIterator it(stays ? source_ : rows, stays ? origin[row] : row); it; ++it)
      entries.emplace_back(row, static_cast<int>(it.col()), it.value());
  }
  take_columns(origin);
  source_.resize(count, rows.cols());
  source_.setFromTriplets(entries.begin(), entries.end());
  ++version_;
  complete_columns(added);
  return true;
}

/// `origin`: the row before of each row, or -1.
void SchurComplement::take_columns(const std::vector<int>& origin) {
  const auto count = static_cast<Eigen::Index>(origin.size());
  Eigen::MatrixXd whole;
  if (whole_matrix_.size()) whole = Eigen::MatrixXd::Zero(count, count);
  std::vector<Eigen::VectorXd> columns(origin.size());
  for (std::size_t row = 0; row < origin.size(); ++row) {
    if (origin[row] < 0 || !known(origin[row])) continue;
    const Column before = column(origin[row]);
    Eigen::VectorXd taken = Eigen::VectorXd::Zero(count);
    for (std::size_t other = 0; other < origin.size(); ++other)
      if (origin[other] >= 0) taken[static_cast<Eigen::Index>(other)] = before[origin[other]];
    if (whole.size())
      whole.col(static_cast<Eigen::Index>(row)) = taken;
    else
      columns[row] = std::move(taken);
  }
  columns_ = std::move(columns);
  whole_matrix_ = std::move(whole);
  single_ = {};
}

/// The columns of added rows, and by symmetry their entries in the others.
void SchurComplement::complete_columns(const std::vector<int>& added) {
  solve_rows(added);
  for (int row = 0; row < static_cast<int>(columns_.size()); ++row)
    for (const int other : added)
      if (whole_matrix_.size() || columns_[row].size()) entries(row)[other] = entries(other)[row];
}

void SchurComplement::forget() {
  most_left_.reset();
  compliance_.assign(support_.size(), Eigen::VectorXd());
  if (keeps_compliance()) factor_.resize(0, 0);
  if (keeps_compliance() || !has_columns())
    clear();
  else
    exact_ = false;
}

void SchurComplement::start_anew() {
  factor_.resize(0, 0);
  clear();
  exact_ = true;
}

}  // namespace comma::solver
