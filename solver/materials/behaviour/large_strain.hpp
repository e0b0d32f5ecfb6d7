// What all laws of large strains share.
#pragma once

#include <Eigen/Dense>

#include "solver/materials/elasticity.hpp"

namespace comma::solver {

/// F = I + H. Throws Error `integration-failure` where det F <= 0: the point is turned inside out.
Eigen::Matrix3d deformation_gradient(const Eigen::Matrix3d& displacement_gradient);

/// (H + H^T + H^T H) / 2, from H rather than from F: small strains must not drown in the rounding of 1.
Eigen::Matrix3d green_lagrange_strain(const Eigen::Matrix3d& displacement_gradient);

/// The derivative of C^-1 by the strain (C - I) / 2, with shear angles.
Matrix6d derivative_of_inverse(const Eigen::Matrix3d& c_inverse);

/// (xx, yy, zz, xy, xz, yz) and back.
Eigen::Matrix3d tensor_of_stress(const Vector6d& stress);
Vector6d components_of_stress(const Eigen::Matrix3d& tensor);

/// F S F^T / det F.
Vector6d cauchy_stress(const Eigen::Matrix3d& displacement_gradient, const Vector6d& second_stress);
/// det(F) F^-1 sigma F^-T.
Vector6d second_stress_of(const Eigen::Matrix3d& displacement_gradient, const Vector6d& cauchy);

}  // namespace comma::solver
