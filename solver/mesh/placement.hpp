// A movement that brings one part of a body to where another lies.
#pragma once

#include <Eigen/Dense>

namespace comma::solver {

/// x -> centre + rotation (x - centre) + translation.
struct Placement {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& at) const {
    return centre + rotation * (at - centre) + translation;
  }
};

}  // namespace comma::solver
