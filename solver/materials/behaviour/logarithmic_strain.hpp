// Logarithmic strains: E = ln(F^T F) / 2 and what laws between E and its dual stress T say on the initial geometry
// (Miehe, Apel and Lambrecht, Computer Methods in Applied Mechanics and Engineering 191, 2002; R5.03.24).
#pragma once

#include <Eigen/Dense>

#include "solver/materials/behaviour/large_strain.hpp"

namespace comma::solver {

/// F = I + H. Green and Lagrange's strain is an isotropic function away from the logarithmic one, e = ln(1 + 2 g) / 2
/// eigenvalue by eigenvalue, so derivatives follow from divided differences of that function (Daleckii and Krein).
class LogarithmicStrain {
 public:
  /// Throws Error `integration-failure` where det F <= 0: the point is turned inside out.
  explicit LogarithmicStrain(const Eigen::Matrix3d& displacement_gradient);

  /// E, with shear angles.
  const Vector6d& strain() const { return strain_; }
  /// The second Piola-Kirchhoff stress whose work is that of T.
  Vector6d second_stress(const Vector6d& t) const { return projection_.transpose() * t; }
  /// T of a second Piola-Kirchhoff stress.
  Vector6d stress_of(const Vector6d& second) const { return projection_.transpose().partialPivLu().solve(second); }
  /// dS / dE_green, for the tangent `d` = dT / dE.
  Matrix6d second_tangent(const Matrix6d& d, const Vector6d& t) const;

 private:
  Eigen::Vector3d values_;  ///< of Green and Lagrange's strain
  Eigen::Matrix3d vectors_;
  Vector6d strain_;
  Matrix6d projection_;  ///< dE / dE_green, both with shear angles
};

}  // namespace comma::solver
