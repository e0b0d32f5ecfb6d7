#include "solver/linear/conjugate_gradient_solver.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/linear/matrix_checks.hpp"

namespace comma::solver {

namespace {

class ConjugateGradientSolver final : public LinearSolver {
 public:
  explicit ConjugateGradientSolver(const LinearOptions& options) : options_(options) {}

  LinearMethod method() const override { return LinearMethod::conjugate_gradient; }

  void analyse(const SymmetricMatrix&) override {}

  FactorReport factorise(const SymmetricMatrix& matrix) override {
    check_finite(matrix);
    matrix_ = matrix;
    norm_ = row_sum_norm(matrix_);
    if (matrix_.rows() == 0) return {};
    FactorReport report;
    if ((matrix_.diagonal().array() <= 0.0).any()) {
      report.verdict = FactorVerdict::indefinite;
      return report;
    }
    iterations_.setTolerance(options_.iteration_tolerance);
    iterations_.setMaxIterations(options_.most_iterations > 0 ? options_.most_iterations : default_iterations());
    iterations_.compute(matrix_);
    if (iterations_.info() != Eigen::Success) report.verdict = FactorVerdict::indefinite;
    return report;
  }

  double solve(Eigen::Ref<Eigen::MatrixXd> rhs) const override {
    double worst = 0.0;
    for (Eigen::Index column = 0; matrix_.rows() > 0 && column < rhs.cols(); ++column) {
      const Eigen::VectorXd b = rhs.col(column);
      const Eigen::VectorXd x = iterations_.solve(b);
      if (iterations_.info() != Eigen::Success) fail();
      const double size = (b - matrix_.selfadjointView<Eigen::Lower>() * x).lpNorm<Eigen::Infinity>();
      const double scale = norm_ * x.lpNorm<Eigen::Infinity>() + b.lpNorm<Eigen::Infinity>();
      if (size > 0.0) worst = std::max(worst, size / scale);
      rhs.col(column) = x;
    }
    return worst;
  }

 private:
  // U4.50.01, NMAX_ITER=0: half the unknowns. Small systems need more than that to make up for rounding.
  int default_iterations() const {
    constexpr int fewest = 100;
    return std::max(fewest, static_cast<int>(matrix_.rows() / 2));
  }

  [[noreturn]] void fail() const {
    throw Error(
        "no-convergence",
        fmt::format("conjugate gradients reach a relative residual of {:.1e} in {} iterations, {:.1e} is wanted",
                    iterations_.error(), iterations_.iterations(), options_.iteration_tolerance),
        "the matrix is ill-conditioned: take a direct solver, MULT_FRONT or MUMPS");
  }

  using Preconditioner = Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::AMDOrdering<int>>;

  LinearOptions options_;
  SymmetricMatrix matrix_;
  double norm_ = 0.0;
  Eigen::ConjugateGradient<SymmetricMatrix, Eigen::Lower, Preconditioner> iterations_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_conjugate_gradient_solver(const LinearOptions& options) {
  return std::make_unique<ConjugateGradientSolver>(options);
}

}  // namespace comma::solver
