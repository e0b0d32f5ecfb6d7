#include "solver/linear/refined_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/linear/double_double.hpp"
#include "solver/linear/equilibration.hpp"
#include "solver/linear/matrix_checks.hpp"
#include "solver/linear/refinement.hpp"

namespace comma::solver {

namespace {

/// Pivots of a scaled positive definite matrix are at most about 1.
constexpr double pivot_growth = 1e6;

/// b - A x in doubled precision, rounded at the end; x = high + low. Where the processor has fused multiply-add it is
/// one instruction, else a call each time.
[[gnu::target_clones("fma", "default")]] void residual(const SymmetricMatrix& matrix, const double* b,
                                                       const double* high, const double* low,
                                                       std::vector<DoubleDouble>& sums, double* result) {
  const int n = static_cast<int>(matrix.rows());
  const int* starts = matrix.outerIndexPtr();
  const int* rows = matrix.innerIndexPtr();
  const double* values = matrix.valuePtr();
  for (int row = 0; row < n; ++row) sums[row] = {b[row], 0.0};
  for (int column = 0; column < n; ++column) {
    DoubleDouble mirrored;
    for (int k = starts[column]; k < starts[column + 1]; ++k) {
      const int row = rows[k];
      const double value = -values[k];
      add_product(sums[row], value, high[column]);
      sums[row].low += value * low[column];
      if (row == column) continue;
      add_product(mirrored, value, high[row]);
      mirrored.low += value * low[row];
    }
    add(sums[column], mirrored.high);
    sums[column].low += mirrored.low;
  }
  for (int row = 0; row < n; ++row) result[row] = sums[row].value();
}

int digits_lost(double pivot, double reference) {
  constexpr int all = std::numeric_limits<double>::max_digits10;
  if (!std::isfinite(pivot) || pivot == 0.0) return all;
  return std::clamp(static_cast<int>(std::floor(std::log10(reference / std::abs(pivot)))), 0, all);
}

}  // namespace

FactorReport judge_pivots(const Eigen::VectorXd& pivots, const Eigen::VectorXd& references, int singular_digits) {
  FactorReport report;
  bool negative = false;
  double largest = 0.0;
  for (Eigen::Index row = 0; row < pivots.size(); ++row) {
    const double pivot = pivots[row];
    largest = std::max(largest, std::abs(pivot) / references[row]);
    const int digits = digits_lost(pivot, references[row]);
    report.lost_digits = std::max(report.lost_digits, digits);
    const bool lost = singular_digits >= 0 && digits > singular_digits;
    if (!std::isfinite(pivot) || pivot == 0.0 || lost)
      report.null_rows.push_back(static_cast<int>(row));
    else if (pivot < 0.0)
      negative = true;
  }
  if (largest > pivot_growth) {
    report.null_rows.clear();
    negative = true;
  }
  if (negative) report.verdict = FactorVerdict::indefinite;
  if (!report.null_rows.empty()) report.verdict = FactorVerdict::singular;
  return report;
}

bool RefinedSolver::has_pattern_of(const SymmetricMatrix& matrix) const {
  return analysed_ && matrix.rows() == matrix_.rows() && matrix.nonZeros() == matrix_.nonZeros() &&
         std::equal(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize() + 1, matrix_.outerIndexPtr()) &&
         std::equal(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros(), matrix_.innerIndexPtr());
}

void RefinedSolver::analyse(const SymmetricMatrix& matrix) {
  matrix_ = matrix;
  matrix_.makeCompressed();
  if (matrix_.rows() > 0) analyse_pattern(matrix_);
  analysed_ = true;
}

FactorReport RefinedSolver::factorise(const SymmetricMatrix& matrix) {
  check_finite(matrix);
  if (!matrix.isCompressed() || !has_pattern_of(matrix))
    analyse(matrix);
  else
    std::copy(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros(), matrix_.valuePtr());
  report_ = {};
  norm_ = row_sum_norm(matrix_);
  factors_ = options_.equilibrate ? equilibration_factors(matrix_) : Eigen::VectorXd::Ones(matrix_.rows());
  if (matrix_.rows() == 0) return report_;
  const SymmetricMatrix working = scaled(matrix_, factors_);
  report_ = factorise_scaled(working, pivot_references(working));
  return report_;
}

void RefinedSolver::check_not_singular() const {
  if (report_.verdict == FactorVerdict::singular) {
    throw Error("singular-matrix", fmt::format("the matrix is singular: {} of its {} rows have no usable pivot",
                                               report_.null_rows.size(), matrix_.rows()));
  }
}

void RefinedSolver::solve_once(Eigen::Ref<Eigen::MatrixXd> rhs) const {
  check_not_singular();
  if (rhs.size() == 0) return;
  if (report_.verdict != FactorVerdict::ok || report_.lost_digits > few_digits + digits_above_pivots()) {
    solve(rhs);
    return;
  }
  rhs.array().colwise() *= factors_.array();
  solve_scaled(rhs);
  rhs.array().colwise() *= factors_.array();
}

double RefinedSolver::solve(Eigen::Ref<Eigen::MatrixXd> rhs) const {
  check_not_singular();
  const RefinedSystem system{
      [this](const double* b, const double* high, const double* low, std::vector<DoubleDouble>& sums, double* result) {
        residual(matrix_, b, high, low, sums, result);
      },
      [this](Eigen::Ref<Eigen::MatrixXd> columns) { solve_scaled(columns); }, factors_, factors_, norm_};
  const double worst = refine(system, options_.refinement_steps, rhs);
  if (worst <= worst_residual) return worst;
  throw Error("inaccurate-solution",
              fmt::format("the solver {} reaches a relative residual of {:.1e} only; refinement does not improve it",
                          name_of(method()), worst),
              "the matrix is not positive definite or nearly singular: use the solver MUMPS, which interchanges rows");
}

}  // namespace comma::solver
