// Stresses in the sections of bars and beams from their section forces (CALC_CHAMP, CONTRAINTE and DEFORMATION;
// U4.81.04).
#pragma once

#include "solver/elements/solids/imposed_strains.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/fields/points/continuum_points.hpp"

namespace comma::solver {

// `forces`: section forces at element nodes (N VY VZ MT MFY MFZ). Cells other than bars and beams carry no result. All
// throw Error `missing-properties` naming a cell without section.

/// SIPO_ELNO, what each force adds to the stress at the outermost fibre: SN = N / A, SVY = VY a_y / A, SVZ = VZ a_z / A
/// with the shear coefficients a = A / A_reduced, SMT = MT R_T / J, SMFY = MFY R_Z / I_Y, SMFZ = -MFZ R_Y / I_Z.
ElementField force_stresses(const FieldInput& input, const ElementField& forces);

/// SIPM_ELNO, the smallest and largest axial stress of the section: SIXXMIN, SIXXMAX. On the corners of a rectangle, on
/// the rim of a circle. Beams of general sections, whose outline is not known, have no values.
ElementField extreme_stresses(const FieldInput& input, const ElementField& forces);

/// DEGE_ELNO, generalised strains: EPXX GAXY GAXZ GAT KY KZ, `imposed` ones (null: none) included; those of command
/// variables in bars alone (17.3 leaves them out of beams, and has none of bars). Shear angles are 0 in Euler's beams.
ElementField generalised_strains(const FieldInput& input, const ElementField& forces,
                                 const ImposedStrains* imposed = nullptr);

}  // namespace comma::solver
