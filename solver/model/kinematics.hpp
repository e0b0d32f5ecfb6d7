// How strains follow from displacements.
#pragma once

#include <cstdint>
#include <vector>

namespace comma::solver {

enum class Kinematics : std::uint8_t {
  small,          ///< the symmetric part of the gradient
  green_lagrange  ///< large displacements and rotations, on the initial geometry
};

/// One a cell; empty: small strains everywhere.
using KinematicsOfCells = std::vector<Kinematics>;

}  // namespace comma::solver
