// Command variables at Gauss points, and the strains that they cause (CALC_CHAMP, VARC and EPVC; U4.81.04).
#pragma once

#include "solver/fields/data/field.hpp"
#include "solver/fields/points/continuum_points.hpp"

namespace comma::solver {

/// VARC_ELGA of continua and bars (in their middle): TEMP, HYDR, SECH, IRRA, CORR, PTOT, NEUT1, NEUT2, and NEUT3,
/// EPSAXX ... EPSAYZ where they are given; absent where a variable is not.
ElementField command_variable_field(const FieldInput& input);

/// EPVC_ELGA of continua: thermal strain along the axes of the material EPTHER_L, EPTHER_T, EPTHER_N, that of drying
/// EPSECH and of hydration EPHYDR, EPPTOT, 0 where nothing causes them. Bars have EPTHER_L alone. Throws Error
/// `missing-reference`.
ElementField variable_strain_field(const FieldInput& input);

}  // namespace comma::solver
