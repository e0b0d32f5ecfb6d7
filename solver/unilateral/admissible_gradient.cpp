#include "solver/unilateral/admissible_gradient.hpp"

#include <algorithm>

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

class AdmissibleGradient {
 public:
  AdmissibleGradient(const std::function<VectorXd(const VectorXd&)>& apply, const ActiveSetProblem& problem,
                     const AdmissibleGradientOptions& options)
      : apply_(apply), excess_(problem.excess), stays_admissible_(options.stays_admissible) {
    x_ = options.start.size() ? options.start : VectorXd::Zero(excess_.size());
    violation_ = excess_;
    if ((x_.array() > 0.0).any()) violation_ -= apply_(x_);
    residual_ = projected();
    direction_ = residual_;
  }

  double violation() const { return residual_.lpNorm<Eigen::Infinity>(); }

  /// False where nothing resists.
  bool advance() {
    const VectorXd image = apply_(direction_);
    const double curvature = direction_.dot(image);
    if (!(curvature > 0.0)) return false;
    const bool changes = take(residual_.dot(direction_) / curvature, image);
    const double size = residual_.squaredNorm();
    residual_ = projected();
    const double conjugate = changes ? 0.0 : residual_.squaredNorm() / size;
    direction_ = residual_ + conjugate * direction_;
    return true;
  }

  ActiveSetSolution solution(int iterations) {
    ActiveSetSolution result;
    result.active = positive_rows(x_);
    result.multipliers = std::move(x_);
    result.iterations = iterations;
    return result;
  }

 private:
  VectorXd projected() const { return (x_.array() > 0.0).select(violation_, violation_.cwiseMax(0.0)); }

  /// Whether the rows that push are others after the step.
  bool take(double step, const VectorXd& image) {
    const Eigen::Array<bool, Eigen::Dynamic, 1> pushed = x_.array() > 0.0;
    Index first = -1;
    for (Index i = 0; i < x_.size() && stays_admissible_; ++i) {
      if (!(direction_[i] < 0.0) || -x_[i] / direction_[i] > step) continue;
      first = i;
      step = -x_[i] / direction_[i];
    }
    x_ += step * direction_;
    if (first >= 0) x_[first] = 0.0;
    const bool is_clipped = (x_.array() < 0.0).any();
    x_ = x_.cwiseMax(0.0);
    if (is_clipped && !stays_admissible_)
      violation_ = excess_ - apply_(x_);
    else
      violation_ -= step * image;
    return (pushed != (x_.array() > 0.0)).any();
  }

  const std::function<VectorXd(const VectorXd&)>& apply_;
  const VectorXd& excess_;
  const bool stays_admissible_;
  VectorXd x_, violation_;  ///< of the rows; positive where one is violated
  VectorXd residual_, direction_;
};

}  // namespace

std::optional<ActiveSetSolution> solve_admissible_gradient(const std::function<VectorXd(const VectorXd&)>& apply,
                                                           const ActiveSetProblem& problem,
                                                           const AdmissibleGradientOptions& options) {
  const int most =
      options.max_iterations > 0 ? options.max_iterations : iterations_a_row * static_cast<int>(problem.excess.size());
  AdmissibleGradient gradient(apply, problem, options);
  for (int iteration = 0; iteration <= most; ++iteration) {
    if (gradient.violation() <= options.tolerance) return gradient.solution(iteration);
    if (!gradient.advance()) break;
  }
  return std::nullopt;
}

}  // namespace comma::solver
