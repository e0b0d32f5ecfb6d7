// Beams whose section changes from the first node to the second (R3.08.01, VARI_SECT of U4.42.01).
//
// With s from 0 to 1 along the beam, each characteristic varies as (1 + c s)^n, with the c that leads from its first
// value to its last.
#pragma once

#include <Eigen/Dense>

#include "solver/elements/slender/section.hpp"
#include "solver/materials/elasticity.hpp"

namespace comma::solver {

/// All sizes of the section vary alike (HOMOTHETIQUE).
inline constexpr VariationPowers all_sizes_vary{};
/// The size along z of a rectangle varies, that along y does not (AFFINE). Second moments go as Code_Aster lets them:
/// I_y linearly and I_z with the third power, although with that size it is I_y that goes with the third power and I_z
/// linearly. Both ends are right in any case, so that it matters less the shorter the beams are: 0.2 % of the
/// deflection for ten beams over which the size halves.
inline constexpr VariationPowers one_size_varies{.area = 1, .inertia_y = 1, .inertia_z = 3, .torsion = 3};

inline bool varies(const BeamSection& section) { return section.end != nullptr; }

/// The section at x = position * length, position in [0, 1]: the first's for a section that does not vary. Shear
/// factors follow from the area and the area reduced for shear, which vary alike; the distances of outermost fibres
/// vary linearly.
BeamSection section_at(const BeamSection& section, double position);

/// The area of the uniform bar that elongates as much (a mean: the geometric one where all sizes vary).
double axial_area(const BeamSection& section);
/// The torsion constant of the uniform beam that twists as much.
double torsion_constant(const BeamSection& section);

/// The stiffness of a beam in one plane (units of v, slope, v, slope at both ends), exact for a beam loaded at its ends
/// alone: the inverse of the flexibility of a cantilever. `rigidity`: E; `shear_rigidity`: G, or 0 for Euler's beam.
struct BendingPlane {
  double inertia_start = 0.0, inertia_end = 0.0;
  double shear_area_start = 0.0, shear_area_end = 0.0;  ///< areas reduced for shear
  int inertia_power = 4, area_power = 2;
};
Eigen::Matrix4d bending_stiffness(const BendingPlane& plane, double length, double rigidity, double shear_rigidity);

}  // namespace comma::solver
