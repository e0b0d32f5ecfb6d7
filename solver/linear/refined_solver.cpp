#include "solver/linear/refined_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/linear/double_double.hpp"
#include "solver/linear/equilibration.hpp"
#include "solver/linear/matrix_checks.hpp"

namespace comma::solver {

namespace {

constexpr double half_ulp = std::numeric_limits<double>::epsilon() / 2.0;
/// Right-hand sides treated together: enough for BLAS kernels, few enough that the copies stay small.
constexpr int block_columns = 32;
/// A correction must at least halve the one before, else rounding has taken over.
constexpr double slowest_contraction = 0.5;
/// Pivots of a scaled positive definite matrix are at most about 1.
constexpr double pivot_growth = 1e6;

/// b - A x in doubled precision, rounded at the end; x = high + low. Where the processor has fused multiply-add it is one
/// instruction, else a call each time.
[[gnu::target_clones("arch=haswell", "default")]] void residual(const SymmetricMatrix& matrix, const double* b, const double* high, const double* low,
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

/// The state of the columns that are refined together.
struct Iterate {
  Eigen::MatrixXd high, low;
  Eigen::VectorXd last_correction;  ///< its largest scaled entry, a column
  std::vector<char> done;

  Iterate(Eigen::Index rows, Eigen::Index columns)
      : high(Eigen::MatrixXd::Zero(rows, columns)),
        low(high),
        last_correction(Eigen::VectorXd::Constant(columns, std::numeric_limits<double>::infinity())),
        done(columns, 0) {}

  bool all_done() const { return std::find(done.begin(), done.end(), 0) == done.end(); }

  /// Adds a correction given in scaled unknowns, unless it shows that refinement no longer gains.
  void correct(Eigen::Index column, const Eigen::VectorXd& scaled_step, const Eigen::VectorXd& factors) {
    const double size = scaled_step.lpNorm<Eigen::Infinity>();
    if (!(size <= slowest_contraction * last_correction[column])) {
      done[column] = 1;
      return;
    }
    for (Eigen::Index row = 0; row < factors.size(); ++row) {
      DoubleDouble sum{high(row, column), low(row, column)};
      add(sum, factors[row] * scaled_step[row]);
      const DoubleDouble normal = exact_sum(sum.high, sum.low);
      high(row, column) = normal.high;
      low(row, column) = normal.low;
    }
    last_correction[column] = size;
    const double scale = high.col(column).cwiseQuotient(factors).lpNorm<Eigen::Infinity>();
    if (size <= half_ulp * scale) done[column] = 1;
  }
};

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
  if (report_.lost_digits > few_digits) {
    solve(rhs);
    return;
  }
  rhs.array().colwise() *= factors_.array();
  solve_scaled(rhs);
  rhs.array().colwise() *= factors_.array();
}

double RefinedSolver::solve(Eigen::Ref<Eigen::MatrixXd> rhs) const {
  check_not_singular();
  double worst = 0.0;
  for (Eigen::Index first = 0; matrix_.rows() > 0 && first < rhs.cols(); first += block_columns) {
    const Eigen::Index count = std::min<Eigen::Index>(block_columns, rhs.cols() - first);
    worst = std::max(worst, solve_block(rhs.middleCols(first, count)));
  }
  if (worst <= worst_residual) return worst;
  throw Error("inaccurate-solution",
              fmt::format("the solver {} reaches a relative residual of {:.1e} only; refinement does not improve it",
                          name_of(method()), worst),
              "the matrix is not positive definite or nearly singular: use the solver MUMPS, which interchanges rows");
}

double RefinedSolver::solve_block(Eigen::Ref<Eigen::MatrixXd> rhs) const {
  const Eigen::Index n = rhs.rows();
  Iterate x(n, rhs.cols());
  Eigen::MatrixXd remainder = rhs;
  Eigen::VectorXd final_residual(n);
  std::vector<DoubleDouble> sums(n);
  for (int step = 0; step <= options_.refinement_steps && !x.all_done(); ++step) {
    remainder.array().colwise() *= factors_.array();
    solve_scaled(remainder);
    for (Eigen::Index column = 0; column < rhs.cols(); ++column) {
      if (!x.done[column]) x.correct(column, remainder.col(column), factors_);
      if (x.done[column])
        remainder.col(column).setZero();
      else
        residual(matrix_, rhs.col(column).data(), x.high.col(column).data(), x.low.col(column).data(), sums,
                 remainder.col(column).data());
    }
  }
  double worst = 0.0;
  x.low.setZero();
  for (Eigen::Index column = 0; column < rhs.cols(); ++column) {
    residual(matrix_, rhs.col(column).data(), x.high.col(column).data(), x.low.col(column).data(), sums,
             final_residual.data());
    const double scale =
        norm_ * x.high.col(column).lpNorm<Eigen::Infinity>() + rhs.col(column).lpNorm<Eigen::Infinity>();
    const double size = final_residual.lpNorm<Eigen::Infinity>();
    // A right-hand side of zeros is solved exactly; what is not finite must not pass a comparison.
    const double relative = size == 0.0 ? 0.0 : size / scale;
    worst = std::isfinite(relative) ? std::max(worst, relative) : std::numeric_limits<double>::infinity();
  }
  rhs = x.high;
  return worst;
}

}  // namespace comma::solver
