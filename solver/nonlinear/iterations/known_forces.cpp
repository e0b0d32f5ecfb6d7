#include "solver/nonlinear/iterations/known_forces.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace comma::solver {
namespace {

/// Of displacements: those of a move are differences of two.
constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
/// A larger multiple would make too much of the rounding of forces.
constexpr double largest_multiple = 10.0;

}  // namespace

void KnownForces::note(const Eigen::VectorXd& u, const Eigen::VectorXd& forces) {
  u_ = u;
  forces_ = forces;
}

Eigen::VectorXd KnownForces::after_move(const Eigen::VectorXd& u, const Eigen::VectorXd& moved,
                                        const Compute& compute) {
  if (u.size() == 0 || u_.size() != u.size() || u_ != u) return compute(moved);
  Eigen::VectorXd move = moved - u;
  Eigen::Index place = 0;
  if (!(move.cwiseAbs().maxCoeff(&place) > 0.0)) return forces_;
  const double multiple = move_.size() ? move[place] / move_[place] : std::numeric_limits<double>::infinity();
  if (std::abs(multiple) <= largest_multiple &&
      ((move - multiple * move_).array().abs() <= rounding * moved.array().abs().max(u.array().abs())).all())
    return forces_ + multiple * change_;
  const Eigen::VectorXd forces = compute(moved);
  move_ = std::move(move);
  change_ = forces - forces_;
  return forces;
}

}  // namespace comma::solver
