// Functions made of tabulated functions: sums, products, envelopes, integrals, derivatives (U4.32.04).
//
// What combines several functions is tabulated at all their abscissas; sums and products as far as every one of them is
// defined there: beyond an end that excludes, they have no points. The new table takes parameter, scales and extensions
// of the first function. All throw Error `out-of-function` when the functions have no abscissa in common, or where one
// cannot be evaluated.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "solver/functions/function.hpp"

namespace comma::solver {

using Functions = std::span<const TabulatedFunction* const>;

/// The abscissas of all the functions within the range of each, rising; those that differ by rounding only are one.
std::vector<double> common_abscissas(Functions functions);

/// sum of coefficients[i] * functions[i]
TabulatedFunction combination(Functions functions, std::span<const double> coefficients);
TabulatedFunction product(Functions functions);
/// This and those below at the points of all functions: error `out-of-function` where one of them excludes one (17.3).
TabulatedFunction mean(Functions functions);
/// At each abscissa the value below which that share (0 to 1) of the functions lies, linear between those in order: 0.5
/// is the median.
TabulatedFunction fractile(Functions functions, double share);
/// The largest or the smallest of the functions at each abscissa.
TabulatedFunction upper_envelope(Functions functions);
TabulatedFunction lower_envelope(Functions functions);

/// The function at other abscissas (rising). Throws Error `out-of-function` where it does not go that far.
TabulatedFunction resampled(const TabulatedFunction& function, std::vector<double> abscissas);
/// The function with another ordinate at each of its points.
TabulatedFunction mapped(const TabulatedFunction& function, const std::function<double(double)>& ordinate);

/// Which of two functions counts where both are.
enum class Overlap : std::uint8_t { left, right };
/// The points of one function and beyond them those of another, with the extensions at their ends. The one that begins
/// first is the left one, `second` where both begin alike (17.3). Scales and names are those of `first`; error
/// `other-scales` where `second` has others.
TabulatedFunction in_succession(const TabulatedFunction& first, const TabulatedFunction& second, Overlap counts);
/// The polynomial of least squares through the points, at their abscissas and linear between them (17.3). Throws Error
/// `out-of-function` where they are no more than the degree.
TabulatedFunction polynomial_fit(const TabulatedFunction& function, int degree);

/// By the trapezoidal rule from the first abscissa, where it is `at_first`. Integrals and derivatives do not go on
/// beyond the points (17.3).
TabulatedFunction integral(const TabulatedFunction& function, double at_first);
/// By Simpson's rule, over the parabola through each point and the two before it; up to the second point by the
/// trapezoidal rule, so that every other value counts from there.
TabulatedFunction simpson_integral(const TabulatedFunction& function, double at_first);
/// The integral from one abscissa to a later one by the distance between them. The integral is tabulated at the points
/// of the function, linear between them and with its extensions beyond them (17.3): only an interval between two points
/// has the mean that the trapezoidal rule gives. Throws Error `out-of-function` beyond an end that excludes.
double mean_between(const TabulatedFunction& function, double from, double to);
/// The slope between the points before and after (17.3), at the ends of the one side. Throws Error `out-of-function`
/// for a single point.
TabulatedFunction derivative(const TabulatedFunction& function);
/// x(y), with scales and ends exchanged, excluded where they were constant; the name of the parameter stays (17.3).
/// Throws Error `out-of-function` when the ordinates neither rise nor fall strictly.
TabulatedFunction inverse(const TabulatedFunction& function);
/// outer(inner(x)) at the abscissas of the inner function, whose parameter it takes; scales, extensions and the name of
/// the result are those of the outer one (17.3).
TabulatedFunction composition(const TabulatedFunction& outer, const TabulatedFunction& inner);

}  // namespace comma::solver
