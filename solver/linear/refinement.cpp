#include "solver/linear/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

constexpr double half_ulp = std::numeric_limits<double>::epsilon() / 2.0;
/// Right-hand sides treated together: enough for BLAS kernels, few enough that the copies stay small.
constexpr int block_columns = 32;
/// A correction must at least halve the one before, else rounding has taken over.
constexpr double slowest_contraction = 0.5;

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

double refine_block(const RefinedSystem& system, int steps, Eigen::Ref<Eigen::MatrixXd> rhs) {
  const Eigen::Index n = rhs.rows();
  Iterate x(n, rhs.cols());
  Eigen::MatrixXd remainder = rhs;
  Eigen::VectorXd final_residual(n);
  std::vector<DoubleDouble> sums(n);
  for (int step = 0; step <= steps && !x.all_done(); ++step) {
    remainder.array().colwise() *= system.row_factors.array();
    system.solve_scaled(remainder);
    for (Eigen::Index column = 0; column < rhs.cols(); ++column) {
      if (!x.done[column]) x.correct(column, remainder.col(column), system.column_factors);
      if (x.done[column])
        remainder.col(column).setZero();
      else
        system.residual(rhs.col(column).data(), x.high.col(column).data(), x.low.col(column).data(), sums,
                        remainder.col(column).data());
    }
  }
  double worst = 0.0;
  x.low.setZero();
  for (Eigen::Index column = 0; column < rhs.cols(); ++column) {
    system.residual(rhs.col(column).data(), x.high.col(column).data(), x.low.col(column).data(), sums,
                    final_residual.data());
    const double scale =
        system.norm * x.high.col(column).lpNorm<Eigen::Infinity>() + rhs.col(column).lpNorm<Eigen::Infinity>();
    const double size = final_residual.lpNorm<Eigen::Infinity>();
    // A right-hand side of zeros is solved exactly; what is not finite must not pass a comparison.
    const double relative = size == 0.0 ? 0.0 : size / scale;
    worst = std::isfinite(relative) ? std::max(worst, relative) : std::numeric_limits<double>::infinity();
  }
  rhs = x.high;
  return worst;
}

}  // namespace

double refine(const RefinedSystem& system, int steps, Eigen::Ref<Eigen::MatrixXd> rhs) {
  if (!rhs.allFinite())
    throw Error(
        "not-finite",
        "the loads are not numbers: a force, a property or a prescribed displacement is infinite or not a number",
        "look at the functions and formulas among them where they divide by zero or take a root of something negative");
  double worst = 0.0;
  for (Eigen::Index first = 0; rhs.rows() > 0 && first < rhs.cols(); first += block_columns) {
    const Eigen::Index count = std::min<Eigen::Index>(block_columns, rhs.cols() - first);
    worst = std::max(worst, refine_block(system, steps, rhs.middleCols(first, count)));
  }
  return worst;
}

}  // namespace comma::solver
