// Axes from angles.
#pragma once

#include <Eigen/Dense>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Axes (rows) of nautical angles in radians: turned by `yaw` about Z, then by `pitch` about the new Y, then by `roll`
/// about the new X (U4.42.01, ANGL_REP, ANGL_NAUT). The first goes down for a positive pitch.
Eigen::Matrix3d nautical_axes(double yaw, double pitch, double roll);

/// Yaw, pitch and roll of right-handed axes (rows): the inverse of nautical_axes(), with a pitch from -pi/2 to pi/2 and
/// no yaw where the first axis is that of Z.
Eigen::Vector3d nautical_angles(const Eigen::Matrix3d& axes);

/// Axes (rows) of Euler's angles in radians: turned about Z, then about the new X, then about the new Z (U4.42.01,
/// ANGL_EULER).
Eigen::Matrix3d euler_axes(double precession, double nutation, double rotation);

/// The mean of a cell's nodes.
Eigen::Vector3d centre_of(const Mesh& mesh, int cell);

/// Axes (rows) at `at` round an axis through `origin` with the nautical angles `yaw` and `pitch`: away from the axis,
/// round it, along it. Throws Error `distorted-cell` for a place on the axis.
Eigen::Matrix3d cylindrical_axes(double yaw, double pitch, const Eigen::Vector3d& origin, const Eigen::Vector3d& at);

/// The axes L, T, N (rows) of a material made round an axis, from those of `cylindrical_axes` (U4.42.01, ANGL_AXE,
/// ORIG_AXE): in the plane L points away from the axis, T round it and N along it (ssls120f); in space L runs along the
/// axis, T round it, and N is normal to the surface of a tube (ssls120e).
Eigen::Matrix3d material_axes_round(const Eigen::Matrix3d& cylindrical, bool in_space);

}  // namespace comma::solver
