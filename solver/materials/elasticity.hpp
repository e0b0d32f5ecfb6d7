// Hooke's law for each kinematic assumption.
//
// Stresses are (xx, yy, zz, xy) in two dimensions and (xx, yy, zz, xy, xz, yz) in three; strains are alike, with the
// shear angles 2 eps_xy, 2 eps_xz, 2 eps_yz.
#pragma once

#include <cstdint>

#include <Eigen/Dense>

#include "solver/materials/material.hpp"

namespace comma::solver {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The entry of the tensor behind each component.
inline constexpr int tensor_row[] = {0, 1, 2, 0, 0, 1};
inline constexpr int tensor_column[] = {0, 1, 2, 1, 2, 2};

/// Isotropic constants at a point.
struct IsotropicModuli {
  double young = 0.0;
  double poisson = 0.0;
};

/// Throws Error `invalid-material` unless young > 0 and -1 < poisson <= 1/2.
void check_elasticity(const IsotropicModuli& material);
/// Throws Error `invalid-material` where poisson is 1/2: stresses do not follow from strains then.
void require_compressible(double poisson);

/// Throws what require_compressible throws.
Matrix6d solid_stiffness(const IsotropicModuli& material);
/// Plane strain and axisymmetry (zz is the hoop direction in the latter).
Eigen::Matrix4d plane_strain_stiffness(const IsotropicModuli& material);
/// Plane stress: the row and column of zz are zero.
Eigen::Matrix4d plane_stress_stiffness(const IsotropicModuli& material);

/// What a plane body lets its material do across the plane, in which N stands then: nothing bears there (`free`: plane
/// stress), or nothing shears
/// (`held`: plane strain, round an axis).
enum class AcrossPlane : std::uint8_t { solid, held, free };

/// The elastic material of a cell. `axes`: rows L, T, N; null: the global axes. They turn anisotropic laws alone.
struct CellMaterial {
  const Elasticity* elasticity = nullptr;
  const Eigen::Matrix3d* axes = nullptr;
  AcrossPlane across = AcrossPlane::solid;  ///< moduli that do not count then may be absent (0)
};

/// Whether the stiffness is the same at all points and times.
bool is_constant(const Elasticity& elasticity);
/// Whether temperature, drying or hydration strain the material at all.
bool expands(const Elasticity& elasticity);
double density(const Elasticity& elasticity, const MaterialPoint& at);

/// Moduli at a point, checked. Throws Error `invalid-material`, `missing-variable`, `out-of-function`.
IsotropicModuli moduli(const IsotropicElasticity& elasticity, const MaterialPoint& at);

/// Stiffness in global axes at a point (R4.01.02). Throws Error `invalid-material` for a law that is not positive
/// definite.
Matrix6d solid_stiffness(const CellMaterial& material, const MaterialPoint& at);
Eigen::Matrix4d plane_strain_stiffness(const CellMaterial& material, const MaterialPoint& at);
Eigen::Matrix4d plane_stress_stiffness(const CellMaterial& material, const MaterialPoint& at);
/// The inverse of solid_stiffness.
Matrix6d solid_compliance(const CellMaterial& material, const MaterialPoint& at);

/// M such that strain(in the axes) = M strain(global), with shear angles; stress(global) = M^T stress(in the axes).
Matrix6d strain_rotation(const Eigen::Matrix3d& axes);

/// Mean coefficients of expansion are given from the definition temperature T_d; from the reference temperature T_r on,
/// the strain is, on the length at T_d (what the length at T_r adds is of second order, and Code_Aster leaves it out:
/// hsnv125f),
///
///     alpha(T) (T - T_d) - alpha(T_r) (T_r - T_d)       (U4.43.01, TEMP_DEF_ALPHA)
///
/// and alpha(T) (T - T_r) without a definition temperature. 0 where no temperature is given. Throws Error
/// `missing-reference` where a temperature is given without its reference.
double thermal_strain(const Expansion& expansion, const MaterialPoint& at);

/// The strain that command variables cause in the unloaded material, in global axes (with shear angles): thermal
/// expansion, drying K (C - C_r), hydration -B h (R7.01.12), and the strain that is known beforehand (U4.43.03, EPSA).
Vector6d inelastic_strain(const CellMaterial& material, const MaterialPoint& at);
/// The same along a bar or beam. Throws Error `unsupported` where a strain is known beforehand.
double inelastic_axial_strain(const IsotropicElasticity& material, const MaterialPoint& at);

}  // namespace comma::solver
