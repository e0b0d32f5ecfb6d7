// Functions of the place that a point of the body has moved to (XF, YF, ZF of U4.44.01).
#pragma once

#include <functional>

#include "solver/functions/function.hpp"

namespace comma::solver {

/// What a FieldFunction holds when it depends on the place on the deformed body, and may depend on the initial one as
/// well: loads that follow the body ask for it by is_of_deformed_place().
struct DeformedPlaceFunction {
  std::function<double(const Point& initial, const Point& now, double time)> value;
  /// Where nothing has moved.
  double operator()(const Point& at, double time) const { return value(at, at, time); }
};

inline bool is_of_deformed_place(const FieldFunction& function) {
  return function.target<DeformedPlaceFunction>() != nullptr;
}

/// At a point that has moved from `initial` to `now`.
inline double value_of_moved(const FieldFunction& function, const Point& initial, const Point& now, double time) {
  const auto* deformed = function.target<DeformedPlaceFunction>();
  return deformed != nullptr ? deformed->value(initial, now, time) : function(initial, time);
}

}  // namespace comma::solver
