// A step of Newton's method for contact whose points lie on nodes.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact_law/condensed_problem.hpp"
#include "solver/contact_law/near_inverse.hpp"
#include "solver/linear/gmres.hpp"

namespace comma::solver {

/// Whether each multiplier belongs to one point, with as many components as the point has rows.
bool has_points_on_nodes(const CondensedProblem& problem);

/// The linearised problem of condensed_problem.hpp, jumps d - S f = balance with forces f = w t(multiplier, d) and
/// r(multiplier, d) = 0, one row of the compliance S an unknown: at each point the linearised traction and residual are
/// six equations for three multipliers, so three combinations are free of them, which is what is left, A_f f + A_d d =
/// b. With d = balance + S f it is a system for the forces alone, half the unknowns of jumps and multipliers together.
/// All values are what Newton's method subtracts.
class NodalStep {
 public:
  struct Change {
    int node = -1;
    int rows = 0;
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
  };

  /// `rows`: those of S that are unknown; must outlive the step.
  explicit NodalStep(const std::vector<int>& rows);

  /// `first`: the place of its first row among the unknown ones. False where the law does not determine the multiplier.
  bool add_point(int first, const CondensedPoint& point, const ContactLaw& law, const ContactLawValue& value);
  void add_spring(int place, double stiffness);

  /// The jumps (one an unknown row) for what exceeds them now; columns of S must have been required.
  Eigen::VectorXd solve(const SchurComplement& schur, const Eigen::VectorXd& balance);
  /// The same by products with S, in single precision where there are no springs; nothing where the tolerance is not
  /// reached.
  std::optional<Eigen::VectorXd> solve_by_products(SchurComplement& schur, const Eigen::VectorXd& balance,
                                                   NearInverse& near, const GmresOptions& options);
  /// After a solution.
  const std::vector<Change>& multiplier_changes() const { return changes_; }
  /// One an unknown row: jumps are what bodies make of these, to more digits than what the law makes of jumps.
  const Eigen::VectorXd& force_changes() const { return force_changes_; }

 private:
  /// The equations of a point whose multiplier has been eliminated, and how to find it again.
  struct Point {
    int first = 0;
    int rows = 0;
    Eigen::Matrix3d by_force, by_jump;
    Eigen::Vector3d constant;
    double weight = 1.0;
    ContactLawValue law;                  ///< residual and its derivatives as pressures
    Eigen::Matrix<double, 3, 6> inverse;  ///< (traction, residual) -> multiplier
  };

  Eigen::VectorXd rhs(const Eigen::VectorXd& balance) const;
  Eigen::VectorXd weighted(Eigen::VectorXd pressures) const;
  Eigen::VectorXd combined(const Eigen::VectorXd& forces, const Eigen::VectorXd& jumps) const;
  std::vector<ForceBlock> blocks() const;
  void take_multipliers(const Eigen::VectorXd& forces, const Eigen::VectorXd& jumps);

  const std::vector<int>& rows_;
  std::vector<Point> points_;
  bool has_springs_ = false;
  std::vector<Change> changes_;  ///< one a point, springs last and without a node
  Eigen::VectorXd force_changes_;
};

}  // namespace comma::solver
