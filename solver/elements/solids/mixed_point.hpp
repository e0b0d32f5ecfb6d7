// A point of a mixed element: the law sees the change of volume that is an unknown of its own, a pressure holds it to
// that of the displacement.
#pragma once

#include <cstdint>

#include <Eigen/Dense>

#include "solver/materials/behaviour/point_law.hpp"

namespace comma::solver {

/// How the change of volume is measured: the trace of small strains, ln J of logarithmic ones, J - 1 where F is split
/// into factors.
enum class VolumeMeasure : std::uint8_t { trace, logarithm, ratio };
VolumeMeasure volume_measure(Kinematics kinematics);

/// The measure of I + H. Of small gradients no digit is lost. Throws Error `integration-failure` where det(I + H) <= 0.
double volume_of(const Eigen::Matrix3d& gradient, VolumeMeasure measure);

/// The gradient with the shape of `gradient` and the volume `swelling`: H + (swelling - tr H) / 3 I, or F (J' /
/// J)^(1/3) - I. Throws Error `integration-failure` for a ratio of -1 or less.
Eigen::Matrix3d with_volume(const Eigen::Matrix3d& gradient, double swelling, VolumeMeasure measure);

/// Where the swelling and the pressure stand behind the six strains.
inline constexpr int swelling_row = 6, pressure_row = 7;

/// What works on the strain (Green and Lagrange's of the displacement in large strains, six components with shear
/// angles), the swelling and the pressure.
struct MixedResponse {
  Vector6d stress;  ///< Cauchy's, or the second Piola-Kirchhoff
  double swelling;  ///< the law's mean stress less the pressure
  double pressure;  ///< the volume that the displacement has less the swelling
  Eigen::Matrix<double, 8, 8>
      tangent;  ///< their derivatives by (strain, swelling, pressure), symmetric if the law's is
};

/// The derivatives of  W(with_volume(H, swelling)) + pressure (volume_of(H) - swelling),  W being the energy whose
/// stress and tangent are `law`, a response at that gradient (three fields of Hu and Washizu; Simo, Taylor and Pister,
/// Computer Methods in Applied Mechanics and Engineering 51, 1985; R3.06.08). The pressure is a third of the trace of
/// Kirchhoff's stress with ln J, of Cauchy's with J - 1.
MixedResponse mixed_response(const Eigen::Matrix3d& gradient, double swelling, double pressure,
                             const PointResponse& law, VolumeMeasure measure);

/// The same of Hooke's law in small strains, at rest.
MixedResponse elastic_mixed_response(double bulk, double shear);

/// d(ln J) / d(measure) where the volume is `swelling`.
double logarithm_slope(double swelling, VolumeMeasure measure);

/// What Code_Aster 17.3 adds to the derivative of the stress by Green and Lagrange's strain where a step begins, with
/// the pressure p alone as an unknown and logarithmic strains: 2 p dev d : dev d, d being the rate of deformation. It
/// is no part of the tangent, but with it iterations that a loose criterion ends end where they do there.
Matrix6d beginning_stiffness(const Eigen::Matrix3d& gradient, double pressure);

/// The same for two fields: the swelling follows from the pressure, as the law's mean stress does from it alone, with
/// the modulus `bulk`. The row and column of the swelling become 0.
void eliminate_swelling(double bulk, MixedResponse& response);

}  // namespace comma::solver
