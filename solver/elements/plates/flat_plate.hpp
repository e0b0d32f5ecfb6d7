// One flat plate on three or four nodes: its place, its section, how it resists, and its stiffness in its own axes.
// Offsets as R3.07.06: the nodes lie on the surface of the mesh, the strains of the mid-surface are those of the nodes
// plus offset times curvature.
#pragma once

#include <Eigen/Dense>

#include "solver/elements/element_block.hpp"
#include "solver/elements/plates/plate_kinematics.hpp"
#include "solver/elements/quadrature.hpp"

namespace comma::solver {

template <int Nodes>
struct FlatPlate {
  Eigen::Matrix3d axes;                     ///< rows: plate_axes()
  Eigen::Matrix<double, 2, Nodes> corners;  ///< in these axes, relative to the first
  const PlateSection* section;
  const IsotropicElasticity* material;
};

/// Throws Error `missing-properties`, `invalid-properties` (thickness and shear factor are positive); `distorted-cell`
/// and `zero-vector` as plate_axes(), the former also for a plate that is not convex.
template <int Nodes>
FlatPlate<Nodes> flat_plate(const BlockInput& input, int cell);

template <int Nodes>
double area_of(const FlatPlate<Nodes>& plate);

/// A direction in the plane, of length 1, that is the cell's whatever the axes of its fields: the first side of a
/// triangle, the line from the middle of the last side of a quadrangle to that of the second.
template <int Nodes>
Eigen::Vector2d first_direction(const FlatPlate<Nodes>& plate);

/// `shears`: DST and DSQ, else DKT and DKQ.
PlateRigidity rigidity_of(const PlateSection& section, const IsotropicModuli& material, bool shears);

/// From e_xx, e_yy, 2 e_xy (or curvatures) to forces (moments) per length, with one of the rigidities of a plate.
Eigen::Matrix3d plane_law(double rigidity, double poisson);

/// In own axes, for u v w theta_x theta_y theta_z of each node. Rotations about the normal, which strain nothing, are
/// tied to those of the surface or held, as COEF_RIGI_DRZ says (U4.42.01).
template <int Nodes>
Eigen::Matrix<double, 6 * Nodes, 6 * Nodes> plate_stiffness(const FlatPlate<Nodes>& plate,
                                                            const PlateRigidity& rigidity, double young,
                                                            const Quadrature& points);

}  // namespace comma::solver
