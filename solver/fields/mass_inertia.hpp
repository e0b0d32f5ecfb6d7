// Mass, centre of gravity and inertia of a part of a body (POST_ELEM, MASS_INER; U4.81.22).
#pragma once

#include <optional>
#include <span>

#include "solver/fields/continuum_points.hpp"

namespace comma::solver {

struct MassInertia {
  double mass = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of gravity
  /// Inertia tensor about the centre: diagonal the integrals of density (y^2 + z^2) ..., off-diagonal those of -density
  /// x y ...
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// Over the cells (all when none are given): continua, bars and beams; the latter with the inertia of their sections. A
/// plane body has a thickness of 1; an axisymmetric one counts whole, all the way round Y. Mass 0 leaves the centre at
/// the origin. Skin cells and discrete elements take no part. Throws Error `missing-material`, `missing-properties`
/// naming a cell.
MassInertia mass_inertia(const FieldInput& input, std::optional<std::span<const int>> cells = {});

}  // namespace comma::solver
