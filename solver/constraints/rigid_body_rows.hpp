// What a rigid motion does to each degree of freedom.
#pragma once

#include <Eigen/Dense>

#include "solver/model/component.hpp"

namespace comma::solver {

/// Row of the motion (translation along X, Y, Z, then rotation about X, Y, Z through a point) for a component of a node
/// at `lever` from that point.
inline Eigen::Matrix<double, 1, 6> rigid_body_row(Component component, const Eigen::Vector3d& lever) {
  Eigen::Matrix<double, 1, 6> row = Eigen::Matrix<double, 1, 6>::Zero();
  const int c = static_cast<int>(component);
  row[c] = 1.0;
  if (c >= 3) return row;
  for (int k = 0; k < 3; ++k) row[3 + k] = Eigen::Vector3d::Unit(k).cross(lever)[c];
  return row;
}

}  // namespace comma::solver
