#include "solver/nonlinear/iterations/known_solutions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace comma::solver {

bool KnownSolutions::take(Eigen::Ref<Eigen::VectorXd> load, const Eigen::VectorXd& row_sizes,
                          const Eigen::VectorXd& rounding) {
  if (load.size() == 0 || row_sizes.size() != load.size()) return false;
  Eigen::Index place = 0;
  load.cwiseAbs().maxCoeff(&place);
  for (std::size_t k = known_.size(); k-- > 0;) {
    const Pair& known = known_[k];
    const double factor = load[place] / known.load[place];
    if (!std::isfinite(factor) || factor == 0.0) continue;
    const double unknown = std::abs(factor) * known.solution.cwiseAbs().maxCoeff();
    Eigen::VectorXd allowed = backward_error * unknown * row_sizes;
    if (rounding.size()) allowed = allowed.cwiseMax(rounding);
    if (!((load - factor * known.load).array().abs() <= allowed.array()).all()) continue;
    load = factor * known.solution;
    std::rotate(known_.begin() + static_cast<std::ptrdiff_t>(k), known_.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                known_.end());
    return true;
  }
  return false;
}

void KnownSolutions::add(Eigen::VectorXd load, Eigen::VectorXd solution) {
  if (known_.size() == most) known_.erase(known_.begin());
  known_.push_back({std::move(load), std::move(solution)});
}

}  // namespace comma::solver
