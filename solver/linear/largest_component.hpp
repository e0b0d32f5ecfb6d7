// The maximum norm of vectors that may be empty.
#pragma once

#include <Eigen/Dense>

namespace comma::solver {

/// The largest magnitude; 0 where there is none, NaN where one is.
template <class Derived>
double largest_component(const Eigen::DenseBase<Derived>& values) {
  return values.size() ? values.derived().array().abs().template maxCoeff<Eigen::PropagateNaN>() : 0.0;
}

}  // namespace comma::solver
