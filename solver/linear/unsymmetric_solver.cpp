#include "solver/linear/unsymmetric_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/SparseLU>
#include <Eigen/SparseQR>

#include "solver/error.hpp"
#include "solver/linear/equilibration.hpp"
#include "solver/linear/matrix_checks.hpp"
#include "solver/linear/mumps_instance.hpp"
#include "solver/linear/refined_solver.hpp"
#include "solver/linear/refinement.hpp"

namespace comma::solver {

namespace {

/// Each pass halves the exponents' spread; eight bring 1e300 to within a factor of about 10.
constexpr int most_scaling_passes = 8;

/// b - A x in doubled precision, rounded at the end; x = high + low. Where the processor has fused multiply-add it is
/// one instruction, else a call each time.
[[gnu::target_clones("fma", "default")]] void general_residual(const GeneralMatrix& matrix, const double* b,
                                                               const double* high, const double* low,
                                                               std::vector<DoubleDouble>& sums, double* result) {
  const int n = static_cast<int>(matrix.rows());
  for (int row = 0; row < n; ++row) sums[row] = {b[row], 0.0};
  for (int column = 0; column < n; ++column) {
    for (GeneralMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      add_product(sums[entry.row()], -entry.value(), high[column]);
      sums[entry.row()].low -= entry.value() * low[column];
    }
  }
  for (int row = 0; row < n; ++row) result[row] = sums[row].value();
}

struct Maxima {
  Eigen::VectorXd rows, columns;
};

/// The largest magnitudes in the rows and columns of R A C.
Maxima maxima_of(const GeneralMatrix& matrix, const Eigen::VectorXd& row_factors,
                 const Eigen::VectorXd& column_factors) {
  Maxima maxima{Eigen::VectorXd::Zero(matrix.rows()), Eigen::VectorXd::Zero(matrix.cols())};
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (GeneralMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      const double size = std::abs(entry.value()) * row_factors[entry.row()] * column_factors[column];
      maxima.rows[entry.row()] = std::max(maxima.rows[entry.row()], size);
      maxima.columns[column] = std::max(maxima.columns[column], size);
    }
  }
  return maxima;
}

/// Brings the largest entries towards 1 by powers of two, as equilibration_factors() does.
void rescale(Eigen::VectorXd& factors, const Eigen::VectorXd& maxima) {
  for (Eigen::Index i = 0; i < factors.size(); ++i) {
    if (maxima[i] > 0.0) factors[i] *= std::ldexp(1.0, static_cast<int>(std::lround(-0.5 * std::log2(maxima[i]))));
  }
}

GeneralMatrix scaled_by(const GeneralMatrix& matrix, const Eigen::VectorXd& row_factors,
                        const Eigen::VectorXd& column_factors) {
  GeneralMatrix result = matrix;
  for (int column = 0; column < result.outerSize(); ++column) {
    for (GeneralMatrix::InnerIterator entry(result, column); entry; ++entry) {
      entry.valueRef() *= row_factors[entry.row()] * column_factors[column];
    }
  }
  return result;
}

/// Where the diagonal is missing or zero it becomes `zero_pivot_shift`.
GeneralMatrix shifted(const GeneralMatrix& matrix) {
  GeneralMatrix diagonal(matrix.rows(), matrix.cols());
  diagonal.setIdentity();
  return matrix + zero_pivot_shift * diagonal;
}

std::vector<int> empty_columns(const GeneralMatrix& matrix) {
  std::vector<int> columns;
  for (int column = 0; column < matrix.outerSize(); ++column) {
    if (matrix.col(column).cwiseAbs().sum() == 0.0) columns.push_back(column);
  }
  return columns;
}

/// Columns that are combinations of the others. Empty ones are seen; else a rank-revealing QR factorisation puts them
/// last.
std::vector<int> dependent_columns(const GeneralMatrix& matrix) {
  if (auto empty = empty_columns(matrix); !empty.empty()) return empty;
  const Eigen::SparseQR<GeneralMatrix, Eigen::COLAMDOrdering<int>> factors(matrix);
  const auto& order = factors.colsPermutation().indices();
  std::vector<int> columns(order.data() + factors.rank(), order.data() + order.size());
  std::ranges::sort(columns);
  return columns;
}

}  // namespace

GeneralMatrix full_matrix(const SymmetricMatrix& symmetric, const SkewMatrix& skew) {
  const GeneralMatrix mirrored = symmetric.selfadjointView<Eigen::Lower>();
  const GeneralMatrix transposed = skew.transpose();
  GeneralMatrix result = mirrored + skew - transposed;
  result.makeCompressed();
  return result;
}

SymmetricMatrix gram_matrix(const GeneralMatrix& matrix) {
  const GeneralMatrix transposed = matrix.transpose();
  const GeneralMatrix product = transposed * matrix;
  return product.triangularView<Eigen::Lower>();
}

/// Of the equilibrated matrix.
class UnsymmetricSolver::Factors {
 public:
  virtual ~Factors() = default;
  /// A pivot is null that has lost more than `digits` decimal digits of what is largest in its column (`references`,
  /// n). Throws Error `out-of-memory`.
  virtual FactorReport factorise(const GeneralMatrix& working, const Eigen::VectorXd& references, int digits) = 0;
  virtual void solve(Eigen::Ref<Eigen::MatrixXd> columns) const = 0;
};

namespace {

/// Eigen keeps the pivots to itself: they are the diagonal of U, which it stores along with L.
struct ReadableLu : Eigen::SparseLU<GeneralMatrix, Eigen::COLAMDOrdering<int>> {
  /// By unknown.
  Eigen::VectorXd pivots() const {
    Eigen::VectorXd in_order(cols());
    for (Eigen::Index j = 0; j < cols(); ++j) {
      for (SCMatrix::InnerIterator entry(m_Lstore, j); entry; ++entry) {
        if (entry.index() == j) in_order[j] = entry.value();
      }
    }
    return colsPermutation().inverse() * in_order;
  }
};

class EigenFactors final : public UnsymmetricSolver::Factors {
 public:
  FactorReport factorise(const GeneralMatrix& working, const Eigen::VectorXd& references, int digits) override {
    lu_ = std::make_unique<ReadableLu>();
    lu_->compute(working);
    if (lu_->info() != Eigen::Success) {
      lu_ = std::make_unique<ReadableLu>();
      lu_->compute(shifted(working));
      digits = digits < 0 ? zero_pivot_digits : std::min(digits, zero_pivot_digits);
    }
    if (lu_->info() == Eigen::Success) return judge_pivots(lu_->pivots().cwiseAbs(), references, digits);
    FactorReport report{FactorVerdict::singular, dependent_columns(working), std::numeric_limits<double>::max_digits10};
    if (report.null_rows.empty())
      throw Error("out-of-memory", "the unsymmetric matrix cannot be factorised: " + lu_->lastErrorMessage());
    return report;
  }
  void solve(Eigen::Ref<Eigen::MatrixXd> columns) const override { columns = lu_->solve(columns).eval(); }

 private:
  std::unique_ptr<ReadableLu> lu_;
};

class MumpsFactors final : public UnsymmetricSolver::Factors {
 public:
  FactorReport factorise(const GeneralMatrix& working, const Eigen::VectorXd& references, int digits) override {
    if (!has_pattern_of(working)) analyse(working);
    mumps_.note_null_pivots(references, digits);
    mumps_.factorise(working);
    FactorReport report;
    report.null_rows = mumps_.null_rows();
    if (!report.null_rows.empty()) report.verdict = FactorVerdict::singular;
    return report;
  }
  void solve(Eigen::Ref<Eigen::MatrixXd> columns) const override { mumps_.solve(columns); }

 private:
  bool has_pattern_of(const GeneralMatrix& working) const {
    return std::ranges::equal(starts_, std::span(working.outerIndexPtr(), working.outerSize() + 1)) &&
           std::ranges::equal(rows_, std::span(working.innerIndexPtr(), working.nonZeros()));
  }

  void analyse(const GeneralMatrix& working) {
    starts_.assign(working.outerIndexPtr(), working.outerIndexPtr() + working.outerSize() + 1);
    rows_.assign(working.innerIndexPtr(), working.innerIndexPtr() + working.nonZeros());
    mumps_.analyse(working);
  }

  MumpsInstance mumps_{MumpsSymmetry::none};
  std::vector<int> starts_, rows_;  ///< the pattern analysed
};

std::unique_ptr<UnsymmetricSolver::Factors> factors_for(Eigen::Index rows) {
  if (rows > small_unsymmetric_system) return std::make_unique<MumpsFactors>();
  return std::make_unique<EigenFactors>();
}

}  // namespace

UnsymmetricSolver::UnsymmetricSolver(const LinearOptions& options) : options_(options) {}
UnsymmetricSolver::~UnsymmetricSolver() = default;

FactorReport UnsymmetricSolver::factorise(const SymmetricMatrix& symmetric, const SkewMatrix& skew) {
  check_finite(symmetric);
  check_finite(skew);
  matrix_ = full_matrix(symmetric, skew);
  const Eigen::Index n = matrix_.rows();
  report_ = {};
  norm_ = 0.0;
  row_factors_ = column_factors_ = Eigen::VectorXd::Ones(n);
  if (n == 0) return report_;
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(n);
  for (int column = 0; column < n; ++column) {
    for (GeneralMatrix::InnerIterator entry(matrix_, column); entry; ++entry)
      sums[entry.row()] += std::abs(entry.value());
  }
  norm_ = sums.maxCoeff();
  for (int pass = 0; options_.equilibrate && pass < most_scaling_passes; ++pass) {
    const Maxima maxima = maxima_of(matrix_, row_factors_, column_factors_);
    rescale(row_factors_, maxima.rows);
    rescale(column_factors_, maxima.columns);
  }
  factorise_scaled(scaled_by(matrix_, row_factors_, column_factors_));
  return report_;
}

void UnsymmetricSolver::factorise_scaled(const GeneralMatrix& working) {
  if (!factors_) factors_ = factors_for(working.rows());
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(working.rows());
  Eigen::VectorXd references = maxima_of(working, ones, ones).columns;
  references = (references.array() > 0.0).select(references, ones);
  report_ = factors_->factorise(working, references, options_.singular_digits);
}

double UnsymmetricSolver::solve(Eigen::Ref<Eigen::MatrixXd> rhs) const {
  if (report_.verdict == FactorVerdict::singular) {
    throw Error("singular-matrix", fmt::format("the matrix is singular: {} of its {} columns have no usable pivot",
                                               report_.null_rows.size(), matrix_.rows()));
  }
  const RefinedSystem system{
      [this](const double* b, const double* high, const double* low, std::vector<DoubleDouble>& sums, double* result) {
        general_residual(matrix_, b, high, low, sums, result);
      },
      [this](Eigen::Ref<Eigen::MatrixXd> columns) { factors_->solve(columns); }, row_factors_, column_factors_, norm_};
  const double worst = refine(system, options_.refinement_steps, rhs);
  if (worst <= LinearSolver::worst_residual) return worst;
  throw Error(
      "inaccurate-solution",
      fmt::format("the unsymmetric solver reaches a relative residual of {:.1e} only; refinement does not improve it",
                  worst),
      "the matrix is nearly singular: look for parts that hardly anything holds");
}

}  // namespace comma::solver
