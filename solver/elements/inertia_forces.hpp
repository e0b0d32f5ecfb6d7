// Forces on the mass of elements in a field of acceleration: weight and centrifugal force.
#pragma once

#include <span>

#include "solver/elements/cell_quadrature.hpp"
#include "solver/elements/external_forces.hpp"

namespace comma::solver {

/// a(x) = at_origin + gradient x.
struct AccelerationField {
  Eigen::Vector3d at_origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();

  Eigen::Vector3d at(const Eigen::Vector3d& x) const { return at_origin + gradient * x; }
};

/// Throws Error `unsupported` where an axisymmetric cell would need a radial acceleration.
AccelerationField gravity_field(const GravityLoad& load, const Model& model);
/// Throws Error `zero-vector` without axis, `unsupported` for an axisymmetric cell unless the axis is its axis of
/// revolution.
AccelerationField centrifugal_field(const RotationLoad& load, const Model& model);

/// Adds factor times the force on the mass of one cell; none for skin cells and cells without element.
void add_inertia_forces(const ForceInput& input, int cell, const AccelerationField& field, double factor,
                        CellSamples& samples, std::span<long double> forces);

}  // namespace comma::solver
