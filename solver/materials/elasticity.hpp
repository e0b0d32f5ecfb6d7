// Hooke's law for each kinematic assumption.
//
// Stresses are (xx, yy, zz, xy) in two dimensions and (xx, yy, zz, xy, xz, yz) in three; strains are alike, with the shear
// angles 2 eps_xy, 2 eps_xz, 2 eps_yz.
#pragma once

#include <Eigen/Dense>

#include "solver/materials/material.hpp"

namespace comma::solver {

/// Throws Error `invalid-material` unless young > 0 and -1 < poisson < 1/2.
void check_elasticity(const IsotropicElasticity& material);

Eigen::Matrix<double, 6, 6> solid_stiffness(const IsotropicElasticity& material);
/// Plane strain and axisymmetry (zz is the hoop direction in the latter).
Eigen::Matrix4d plane_strain_stiffness(const IsotropicElasticity& material);
/// Plane stress: the row and column of zz are zero.
Eigen::Matrix4d plane_stress_stiffness(const IsotropicElasticity& material);

}  // namespace comma::solver
