// Command variables at Gauss points, and the strains that they cause (CALC_CHAMP, VARC and EPVC; U4.81.04).
#pragma once

#include "solver/fields/continuum_points.hpp"
#include "solver/fields/field.hpp"

namespace comma::solver {

/// VARC_ELGA of continua: TEMP, SECH, HYDR, NEUT1 ... NEUT3, EPSAXX ... EPSAYZ; absent where a variable is not given.
ElementField command_variable_field(const FieldInput& input);

/// EPVC_ELGA of continua: thermal strain along the axes of the material EPTHER_L, EPTHER_T, EPTHER_N, that of drying
/// EPSECH and of hydration EPHYDR, 0 where nothing causes them. Throws Error `missing-reference`.
ElementField variable_strain_field(const FieldInput& input);

}  // namespace comma::solver
