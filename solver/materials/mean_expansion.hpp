// Mean coefficients of thermal expansion that were measured from another temperature than the reference.
#pragma once

#include "solver/functions/function.hpp"
#include "solver/materials/property.hpp"

namespace comma::solver {

/// The coefficients alpha(T), measured from the definition temperature T_d, as they are from the reference temperature
/// T_r on (1/K): at each point T_i of the table
///
///     (alpha(T_i) (T_i - T_d) - alpha(T_r) (T_r - T_d)) / (T_i - T_r)
///
/// or, where T_i is `nearness` from T_r or less, the limit alpha(T_r) + alpha'(T_r) (T_r - T_d); between the points as
/// the table says (R4.08.01, section 2.2). The slope is the mean of those to the points on either side, or the one that
/// there is. Throws Error `out-of-function` where T_r lies outside a table that ends.
TabulatedFunction expansion_from(double reference, const TabulatedFunction& measured, double definition_temperature,
                                 double nearness);

/// The same for the reference temperature of the point where the property is evaluated. Throws Error
/// `missing-variable`, `missing-reference`, `out-of-function`.
Property mean_expansion(TabulatedFunction measured, double definition_temperature, double nearness);

}  // namespace comma::solver
