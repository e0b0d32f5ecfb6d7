#include "solver/unilateral/multiplier_course.hpp"

#include <algorithm>
#include <limits>

namespace comma::solver {

/// By Lagrange's polynomials.
Eigen::VectorXd MultiplierCourse::extrapolated(std::span<const Step> steps, double time) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(steps.back().multipliers.size());
  for (const Step& step : steps) {
    double weight = 1.0;
    for (const Step& other : steps)
      if (&other != &step) weight *= (time - other.time) / (step.time - other.time);
    sum += weight * step.multipliers;
  }
  return sum;
}

std::size_t MultiplierCourse::best_count() const {
  const Step& last = steps_.back();
  const auto before = std::span(steps_).first(steps_.size() - 1);
  std::size_t best = std::min<std::size_t>(1, before.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t count = 1; count <= before.size(); ++count) {
    const double error = (extrapolated(before.last(count), last.time) - last.multipliers).norm();
    if (error < least) best = count;
    least = std::min(least, error);
  }
  return best == before.size() ? steps_.size() : best;
}

Eigen::VectorXd MultiplierCourse::expected(double time, const Eigen::VectorXd& multipliers) const {
  if (steps_.empty() || steps_.back().time == time || steps_.back().multipliers != multipliers) return multipliers;
  const Eigen::VectorXd next = extrapolated(std::span(steps_).last(best_count()), time);
  return (multipliers.array() > 0.0).select(next.cwiseMax(0.0), multipliers);
}

void MultiplierCourse::begin(double time, const Eigen::VectorXd& multipliers) {
  if (!steps_.empty()) return;
  note(time, multipliers);
  begins_ = true;
}

void MultiplierCourse::note(double time, const Eigen::VectorXd& multipliers) {
  if (!steps_.empty() && steps_.back().multipliers.size() != multipliers.size()) steps_.clear();
  while (!steps_.empty() && steps_.back().time >= time) steps_.pop_back();
  if (steps_.empty()) begins_ = false;
  if (steps_.size() == (begins_ ? 3 : most)) {
    steps_.erase(steps_.begin());
    begins_ = false;
  }
  steps_.push_back({time, multipliers});
}

}  // namespace comma::solver
