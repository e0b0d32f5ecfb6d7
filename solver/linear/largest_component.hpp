// The maximum norm of vectors that may be empty.
#pragma once

#include <cmath>
#include <initializer_list>

#include <Eigen/Dense>

namespace comma::solver {

/// The largest magnitude; 0 where there is none, NaN where one is.
template <class Derived>
double largest_component(const Eigen::DenseBase<Derived>& values) {
  return values.size() ? values.derived().array().abs().template maxCoeff<Eigen::PropagateNaN>() : 0.0;
}

/// The largest of numbers that are not negative; NaN where one is, which std::max drops.
inline double largest_of(std::initializer_list<double> values) {
  double largest = 0.0;
  for (const double value : values)
    if (std::isnan(value) || value > largest) largest = value;
  return largest;
}

}  // namespace comma::solver
