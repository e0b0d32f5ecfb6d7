// How much more than its area alone a hollow rectangle shears under a force across a beam.
#pragma once

namespace comma::solver {

/// Half the outer sizes of a rectangle and of the rectangular hole in its middle.
struct HollowRectangle {
  double y, z;
  double hole_y, hole_z;
};

/// The area over the reduced area for a force along z (A_Z of U4.42.01), from the energy of Saint-Venant's stresses in
/// bending without lateral contraction, as the 6/5 of a solid rectangle and Cowper's 2 of a thin tube: the stresses are
/// V / I grad w with div grad w = -z and no flux through the outline, so that the coefficient is A / I^2 times the
/// integral of z w. By high-order elements on a quarter of the section, graded towards the corner of the hole, where
/// stresses are infinite; to 1e-5, 1e-4 where walls are thinner than a hundredth of the sides.
double shear_coefficient_along_z(const HollowRectangle& section);

}  // namespace comma::solver
