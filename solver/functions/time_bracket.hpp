// Values known at some instants, and linear in time between them.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "solver/functions/function.hpp"

namespace comma::solver {

/// The value at a time is (1 - share) times that of the instant `first` and share times that of the next one. The share
/// is 0 where one instant is enough, and lies outside [0, 1] where the two are continued in a straight line.
struct TimeBracket {
  std::size_t first = 0;
  double share = 0.0;
};

/// `instants`: rising, at least one; a single one is continued as a constant. A time that misses the first or the last
/// instant by rounding is that instant. Throws Error `out-of-function` naming `what` for a time before or after them
/// where that is excluded.
TimeBracket time_bracket(std::span<const double> instants, double time, Extension left, Extension right,
                         std::string_view what);

}  // namespace comma::solver
