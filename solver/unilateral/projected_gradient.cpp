#include "solver/unilateral/projected_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace comma::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Below this share of |p| |S p| a curvature is rounding: nothing resists the multipliers along p.
constexpr double no_curvature = 1e-14;
constexpr int power_steps = 8;

class ProjectedGradient {
 public:
  ProjectedGradient(const std::function<VectorXd(const VectorXd&)>& apply, const ActiveSetProblem& problem,
                    const ProjectedGradientOptions& options)
      : apply_(apply),
        problem_(problem),
        first_(options.start),
        scaling_(options.scaling.size() ? options.scaling : VectorXd::Ones(problem.excess.size())),
        limits_(scaling_.cwiseProduct((gradient_share * problem.scale).cwiseMin(options.tolerance))),
        allowed_(options.tolerance * scaling_),
        limit_(options.max_iterations > 0 ? options.max_iterations
                                          : 100 + default_iterations * static_cast<int>(problem.excess.size())),
        last_(options.max_iterations > 0 ? limit_ : further_iterations * limit_) {}

  ActiveSetSolution run() {
    start();
    const double step = 1.0 / largest_eigenvalue();
    VectorXd direction = free_gradient();
    while (!is_within(limits_)) {
      if (solution_.iterations >= limit_ && (is_within(allowed_) || solution_.iterations >= last_)) {
        if (!is_within(allowed_)) solution_.verdict = ActiveSetVerdict::too_many_iterations;
        break;
      }
      ++solution_.iterations;
      const VectorXd chopped = chopped_gradient();
      const VectorXd free = free_gradient();
      if (chopped.squaredNorm() <= reduced(free, step).dot(free)) {
        if (!advance(direction, step)) break;
      } else if (!proportion(chopped)) {
        break;
      } else {
        direction = free_gradient();
      }
    }
    return finish();
  }

 private:
  VectorXd image(const VectorXd& x) const { return scaling_.cwiseProduct(apply_(scaling_.cwiseProduct(x))); }

  void start() {
    x_ = VectorXd::Zero(problem_.excess.size());
    gradient_ = -scaling_.cwiseProduct(problem_.excess);
    if (!first_.size() || !(first_.array() > 0.0).any()) return;
    x_ = first_.cwiseQuotient(scaling_);
    const VectorXd curved = image(x_);
    // Along the start the dual is lowest at this multiple: with loads that grow in proportion it is the solution.
    const double multiple = -gradient_.dot(x_) / x_.dot(curved);
    const double taken = std::isfinite(multiple) && multiple > 0.0 ? multiple : 1.0;
    x_ *= taken;
    gradient_ += taken * curved;
  }

  /// By the power method, from below; a third covers it.
  double largest_eigenvalue() const {
    VectorXd x = VectorXd::Ones(x_.size());
    double value = 0.0;
    for (int k = 0; k < power_steps; ++k) {
      x.normalize();
      x = image(x);
      value = x.norm();
      if (!(value > 0.0)) break;
    }
    return std::max(1.33 * value, std::numeric_limits<double>::min());
  }

  VectorXd free_gradient() const { return (x_.array() > 0.0).select(gradient_, 0.0); }
  VectorXd chopped_gradient() const { return (x_.array() > 0.0).select(0.0, gradient_.cwiseMin(0.0)); }
  VectorXd reduced(const VectorXd& free, double step) const { return free.cwiseMin(x_ / step); }

  bool is_within(const VectorXd& most) const {
    const VectorXd left = free_gradient() + chopped_gradient();
    return (left.array().abs() <= most.array()).all();
  }

  bool has_curvature(const VectorXd& p, const VectorXd& image_of_p) {
    if (p.dot(image_of_p) > no_curvature * p.norm() * image_of_p.norm()) return true;
    solution_.verdict = ActiveSetVerdict::contradictory;
    return false;
  }

  /// A conjugate step, or as much of it as the signs allow and then a projected one.
  bool advance(VectorXd& direction, double step) {
    const VectorXd curved = image(direction);
    if (!has_curvature(direction, curved)) return false;
    const double curvature = direction.dot(curved);
    const double wanted = gradient_.dot(direction) / curvature;
    double allowed = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < x_.size(); ++i)
      if (direction[i] > 0.0) allowed = std::min(allowed, x_[i] / direction[i]);
    x_ -= std::min(wanted, allowed) * direction;
    gradient_ -= std::min(wanted, allowed) * curved;
    if (wanted <= allowed) {
      const VectorXd free = free_gradient();
      direction = free - free.dot(curved) / curvature * direction;
    } else {
      x_ = (x_.cwiseMax(0.0) - step * free_gradient()).cwiseMax(0.0);
      gradient_ = image(x_) - scaling_.cwiseProduct(problem_.excess);
      direction = free_gradient();
    }
    return true;
  }

  bool proportion(const VectorXd& chopped) {
    const VectorXd curved = image(chopped);
    if (!has_curvature(chopped, curved)) return false;
    const double length = gradient_.dot(chopped) / chopped.dot(curved);
    x_ -= length * chopped;
    gradient_ -= length * curved;
    return true;
  }

  ActiveSetSolution finish() {
    solution_.multipliers = scaling_.cwiseProduct(x_);
    solution_.active = positive_rows(x_);
    return std::move(solution_);
  }

  const std::function<VectorXd(const VectorXd&)>& apply_;
  const ActiveSetProblem& problem_;
  const VectorXd& first_;
  const VectorXd scaling_;
  const VectorXd limits_, allowed_;
  const int limit_, last_;
  VectorXd x_, gradient_;
  ActiveSetSolution solution_;
};

}  // namespace

ActiveSetSolution solve_projected_gradient(const std::function<VectorXd(const VectorXd&)>& apply,
                                           const ActiveSetProblem& problem, const ProjectedGradientOptions& options) {
  return ProjectedGradient(apply, problem, options).run();
}

}  // namespace comma::solver
