#include "solver/linear/multigrid_solver.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/linear/matrix_checks.hpp"
#include "solver/linear/multigrid.hpp"

namespace comma::solver {
namespace {

class MultigridSolver final : public LinearSolver {
 public:
  explicit MultigridSolver(const LinearOptions& options) : solid_(options.solid) {
    if (!solid_) throw Error("unsupported", "multigrid needs to know where the unknowns of the solid lie");
  }

  LinearMethod method() const override { return LinearMethod::multigrid; }

  void analyse(const SymmetricMatrix&) override {}

  FactorReport factorise(const SymmetricMatrix& matrix) override {
    check_finite(matrix);
    norm_ = row_sum_norm(matrix);
    FactorReport report;
    if ((matrix.diagonal().array() <= 0.0).any()) {
      report.verdict = FactorVerdict::indefinite;
      return report;
    }
    multigrid_ = std::make_unique<Multigrid>(matrix, *solid_);
    if (!multigrid_->usable()) report.verdict = FactorVerdict::indefinite;
    return report;
  }

  double solve(Eigen::Ref<Eigen::MatrixXd> rhs) const override {
    double worst = 0.0;
    for (Eigen::Index column = 0; column < rhs.cols(); ++column) {
      const Eigen::VectorXd b = multigrid_->padded(rhs.col(column));
      const Eigen::VectorXd x = iterate(b);
      Eigen::VectorXd residual(b.size());
      multigrid_->multiply(x, residual);
      residual = b - residual;
      const double size = residual.lpNorm<Eigen::Infinity>();
      const double scale = norm_ * x.lpNorm<Eigen::Infinity>() + b.lpNorm<Eigen::Infinity>();
      if (size > 0.0) worst = std::max(worst, size / scale);
      rhs.col(column) = multigrid_->unpadded(x);
    }
    return worst;
  }

 private:
  Eigen::VectorXd iterate(const Eigen::VectorXd& b) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
    Eigen::VectorXd r = b;
    Eigen::VectorXd z(b.size());
    Eigen::VectorXd direction = x;
    Eigen::VectorXd image(b.size());
    Eigen::VectorXd last_r = x;
    double last_product = 1.0;
    double energy = 0.0;
    double share = 1.0;
    for (int iteration = 0; iteration <= most_multigrid_iterations; ++iteration) {
      multigrid_->precondition(r, z);
      const double product = r.dot(z);
      if (product == 0.0 && r.isZero(0.0)) return x;
      if (!(product > 0.0)) break;  // no preconditioner at all
      // Energy of the solution so far; of the first guess while there is none.
      share = std::sqrt(product / (energy > 0.0 ? energy : product));
      if (iteration > 0 && share <= multigrid_tolerance) return x;
      direction = z + (iteration > 0 ? (product - z.dot(last_r)) / last_product : 0.0) * direction;
      multigrid_->multiply(direction, image);
      const double curvature = direction.dot(image);
      if (!(curvature > 0.0)) break;
      const double step = r.dot(direction) / curvature;
      last_r = r;
      last_product = product;
      x += step * direction;
      r -= step * image;
      energy += step * step * curvature;
    }
    throw Error("no-convergence",
                fmt::format("multigrid leaves a relative error of {:.1e} after {} iterations, {:.1e} is wanted", share,
                            most_multigrid_iterations, multigrid_tolerance),
                "the elements are nearly incompressible or very flat: take a direct solver, MULT_FRONT or MUMPS");
  }

  std::shared_ptr<const SolidUnknowns> solid_;
  std::unique_ptr<Multigrid> multigrid_;
  double norm_ = 0.0;
};

}  // namespace

std::unique_ptr<LinearSolver> make_multigrid_solver(const LinearOptions& options) {
  return std::make_unique<MultigridSolver>(options);
}

}  // namespace comma::solver
