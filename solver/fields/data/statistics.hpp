// What a set of values comes down to: means along a line, extremes and where they are.
#pragma once

#include <optional>
#include <span>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// A quantity along a line, linear between its points (U4.81.21, section MOYENNE). With the length l of the line,
/// `mean` is the integral over l, `slope` that of 12 (s - l / 2) over l^2: the straight line of the same force and
/// moment goes from `first` = mean - slope / 2 to `last` = mean + slope / 2.
struct LineMean {
  double mean = 0.0;
  double slope = 0.0;
  double least = 0.0;
  double greatest = 0.0;
  double first() const { return mean - 0.5 * slope; }
  double last() const { return mean + 0.5 * slope; }
};
/// `abscissas` rise. Throws Error `zero-vector` for a line without length.
LineMean line_mean(std::span<const double> abscissas, std::span<const double> values);

/// A value and the place (node or cell) and point that has it.
struct Extreme {
  double value = 0.0;
  int place = -1;
  int point = 0;
};
struct Extremes {
  Extreme least, greatest, least_magnitude, greatest_magnitude;
};
/// Over the places (all when none are given); nothing when none of them carries the component.
std::optional<Extremes> extremes(const Field& field, int component, std::optional<std::span<const int>> places = {});

}  // namespace comma::solver
