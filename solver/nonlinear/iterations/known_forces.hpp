// Internal forces where a step of linear bodies begins.
#pragma once

#include <functional>

#include <Eigen/Dense>

namespace comma::solver {

/// Of bodies whose internal forces are linear in the displacements. A step begins where the last one has ended, but for
/// what conditions impose: where these grow in proportion, what they add to the forces is a multiple of what they have
/// added before, and no element need be looked at.
class KnownForces {
 public:
  using Compute = std::function<Eigen::VectorXd(const Eigen::VectorXd& u)>;

  /// The forces (N, one a degree of freedom, as u) at u.
  void note(const Eigen::VectorXd& u, const Eigen::VectorXd& forces);
  /// Those at `moved`, to where conditions have moved u: from the forces known at u and an earlier move that this one
  /// is a multiple of, but for the rounding of displacements; else computed.
  Eigen::VectorXd after_move(const Eigen::VectorXd& u, const Eigen::VectorXd& moved, const Compute& compute);

 private:
  Eigen::VectorXd u_, forces_;     ///< where forces are known
  Eigen::VectorXd move_, change_;  ///< an earlier move, and what it added to them
};

}  // namespace comma::solver
