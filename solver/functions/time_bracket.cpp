#include "solver/functions/time_bracket.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

// Instants are sums of steps: one that misses a known instant by rounding is that one.
constexpr double same_instant = 1e-10;

}  // namespace

TimeBracket time_bracket(std::span<const double> instants, double time, Extension left, Extension right,
                         std::string_view what) {
  const double first = instants.front();
  const double last = instants.back();
  const double margin = same_instant * std::max(std::abs(first), std::abs(last));
  const bool before = time < first - margin;
  const bool after = time > last + margin;
  const Extension extension = before ? left : right;
  if ((before || after) && extension == Extension::excluded) {
    throw Error("out-of-function",
                fmt::format("{} is asked for at time {}, but it is given {}", what, time,
                            instants.size() == 1 ? fmt::format("at {} alone", first)
                                                 : fmt::format("from {} to {}", first, last)),
                fmt::format("extend it on the {}", before ? "left" : "right"));
  }
  const bool constant = extension == Extension::constant || instants.size() == 1;
  if (time <= first && (!before || constant)) return {};
  if (time >= last && (!after || constant)) return {instants.size() - 1, 0.0};
  const auto next = std::lower_bound(instants.begin() + 1, instants.end() - 1, time);
  const auto index = static_cast<std::size_t>(next - instants.begin()) - 1;
  return {index, (time - instants[index]) / (instants[index + 1] - instants[index])};
}

}  // namespace comma::solver
