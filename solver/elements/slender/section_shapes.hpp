// Cross-sections of bars and beams from their dimensions (U4.42.01, POUTRE and BARRE; formulas of R3.08.03).
#pragma once

#include "solver/elements/slender/section.hpp"

namespace comma::solver {

/// A rectangle, solid or with a rectangular hole in its middle. Lengths in the mesh's unit.
struct Rectangle {
  double height_y = 0.0;  ///< outer size along the own y axis
  double height_z = 0.0;
  double thickness_y = 0.0;  ///< of the walls that y crosses; half of the height, or 0: there is no hole
  double thickness_z = 0.0;
};

/// Torsion of a solid rectangle by the approximation of Roark (Formulas for Stress and Strain, table 20, within 0.5 %);
/// of a hollow one by Bredt for thin walls. Shear: 6/5 for a solid one, box_shear() for a hollow one,
/// shear_coefficient_along_z() where its walls are too thin for that.
/// Throws Error `invalid-section` unless lengths are positive and the walls leave a hole.
BeamSection rectangular_section(const Rectangle& rectangle);

/// A disc or, with a wall thinner than the radius, a tube. Shear factors by Cowper (The shear coefficient in
/// Timoshenko's beam theory, 1966) for a Poisson's ratio of 0: 7/6 for a disc, 2 for a thin tube. Throws Error
/// `invalid-section` unless 0 < thickness <= radius.
BeamSection circular_section(double radius, double thickness);

/// A section that changes from `first` to `last` along the beam (varying_section.hpp). Throws Error `invalid-section`
/// where the centre of torsion moves.
BeamSection varying_section(BeamSection first, const BeamSection& last, const VariationPowers& powers);

/// The section of a curved pipe, which ovalises in bending: second moments divided by the factors of flexibility of
/// bending in the planes (x, y) and (x, z) (U4.42.01, COUDE). Throws Error `invalid-section` unless the factors are
/// positive.
BeamSection softened(BeamSection section, double factor_xy, double factor_xz);

}  // namespace comma::solver
