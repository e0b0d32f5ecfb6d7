// Rubber: the energy of Signorini in large strains (R5.03.19, R5.03.23).
#pragma once

#include "solver/materials/elasticity.hpp"
#include "solver/materials/plasticity.hpp"

namespace comma::solver {

struct HyperelasticResponse {
  Vector6d stress;   ///< second Piola-Kirchhoff
  Matrix6d tangent;  ///< d stress / d (Green-Lagrange strain), with shear angles
};

/// The energy a volume at rest is C10 (I - 3) + C01 (II - 3) + C20 (I - 3)^2 + K / 2 (J - 1)^2 with the invariants I =
/// J^(-2/3) tr C and II = J^(-4/3) (tr(C)^2 - tr(C^2)) / 2. Throws Error `integration-failure` where det F <= 0.
HyperelasticResponse hyperelastic_response(const Hyperelasticity& material,
                                           const Eigen::Matrix3d& displacement_gradient);

/// The same displacement gradient with the change of thickness H_zz at which nothing acts across the plane (x, y).
/// Throws Error `integration-failure` where there is none.
Eigen::Matrix3d gradient_in_plane_stress(const Hyperelasticity& material, const Eigen::Matrix3d& displacement_gradient);

/// That energy. Throws as above.
double hyperelastic_energy(const Hyperelasticity& material, const Eigen::Matrix3d& displacement_gradient);

/// Moduli of small strains: mu = 2 (C10 + C01), and K.
IsotropicModuli small_strain_moduli(const Hyperelasticity& material);

}  // namespace comma::solver
