// Mass, centre of gravity and inertia of a part of a body (POST_ELEM, MASS_INER; U4.81.22).
#pragma once

#include <optional>
#include <span>

#include "solver/fields/points/continuum_points.hpp"

namespace comma::solver {

struct MassInertia {
  double mass = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of gravity
  /// Inertia tensor about the centre: diagonal the integrals of density (y^2 + z^2) ..., off-diagonal those of -density
  /// x y ...
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// The moments about three axes that diagonalise an inertia tensor, rising, and these axes (rows), right-handed. The
/// first points to where its first component is positive, the second to where the roll is no more than 90 degrees. Of
/// axes about which moments are equal the one counts first onto which an axis of the mesh projects best.
struct PrincipalInertia {
  Eigen::Vector3d moments;
  Eigen::Matrix3d axes;
};
PrincipalInertia principal_inertia(const Eigen::Matrix3d& inertia);

/// The inertia tensor about another point (Steiner).
Eigen::Matrix3d inertia_about(const MassInertia& body, const Eigen::Vector3d& point);

/// Over the cells (all when none are given): continua, bars, beams and plates; beams with the inertia of their
/// sections, plates with that of their thickness, as if their middle lay on the surface of the mesh. A plane body has a
/// thickness of 1; an axisymmetric one counts whole, all the way round its axis, which is Z here. Mass 0 leaves the
/// centre at the origin. Skin cells and discrete elements take no part. Throws Error `missing-material`,
/// `missing-properties` naming a cell.
MassInertia mass_inertia(const FieldInput& input, std::optional<std::span<const int>> cells = {});

}  // namespace comma::solver
