// Plasticity with isotropic hardening in large strains by the multiplicative split F = F^e F^p (Simo and Miehe,
// Computer Methods in Applied Mechanics and Engineering 98, 1992; R5.03.21).
#pragma once

#include "solver/materials/behaviour/hardening.hpp"

namespace comma::solver {

struct MultiplicativeState {
  Eigen::Matrix3d elastic = Eigen::Matrix3d::Identity();  ///< b: the elastic part of F F^T, for F of determinant 1
  double p = 0.0;
  bool flowing = false;
};

struct MultiplicativeResponse {
  MultiplicativeState state;
  Vector6d stress;   ///< second Piola-Kirchhoff
  Matrix6d tangent;  ///< d stress / d (Green-Lagrange strain), with shear angles; not symmetric where it flows
};

/// From the state at the displacement gradient `before` to `now`. Kirchhoff's stress is
///
///     tau = mu dev b + (K / 2 (J^2 - 1) - 3/2 K e (J + 1 / J)) I,
///
/// e the expansion by the temperature; yield where sqrt(3/2) |tau| > R(p), and then, with the trace t of the trial,
///
///     sqrt(3/2) |tau_trial| - mu t dp - R(p + dp) = 0;
///
/// the trace of the new b is that of a tensor of determinant 1.
/// Throws Error `integration-failure` where det F <= 0.
MultiplicativeResponse integrate_multiplicative(const PlasticPoint& point, const MultiplicativeState& state,
                                                const Eigen::Matrix3d& before, const Eigen::Matrix3d& now,
                                                double expansion);

}  // namespace comma::solver
