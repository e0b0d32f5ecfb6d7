// Functions of the place that a point of the body has moved to (XF, YF, ZF of U4.44.01).
#pragma once

#include "solver/functions/function.hpp"

namespace comma::solver {

/// What a FieldFunction holds when its place is that of the deformed body: loads that follow the body ask for it by
/// is_of_deformed_place().
struct DeformedPlaceFunction {
  FieldFunction value;
  double operator()(const Point& at, double time) const { return value(at, time); }
};

inline bool is_of_deformed_place(const FieldFunction& function) {
  return function.target<DeformedPlaceFunction>() != nullptr;
}

}  // namespace comma::solver
