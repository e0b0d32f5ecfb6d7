// How a straight beam moves between its ends, and the end forces that do the work of a distributed load (R3.08.01).
#pragma once

#include <functional>

#include <Eigen/Dense>

#include "solver/elements/slender/section.hpp"
#include "solver/materials/elasticity.hpp"

namespace comma::solver {

/// `softening`: the ratio of shear to bending flexibility, 12 E I / (G A_reduced L^2), for bending in the planes (x, y)
/// and (x, z); 0 for Euler's beam.
struct BeamInterpolation {
  double length = 0.0;
  double softening_y = 0.0;
  double softening_z = 0.0;
};

BeamInterpolation timoshenko_interpolation(const BeamSection& section, const IsotropicModuli& material, double length);

/// Displacements and rotations in own axes at x = position * length, position in [0, 1], from those of the ends: the
/// exact solution for a beam that is loaded at its ends alone.
Eigen::Matrix<double, 6, 12> interpolate(const BeamInterpolation& beam, double position);

/// A load per length in own axes (N VY VZ MT MFY MFZ) at x = position * length.
using LineLoad = std::function<Eigen::Matrix<double, 6, 1>(double position)>;

/// Forces and moments at the ends (own axes) that do the work of a load, which varies with at most the fourth power of
/// the position, on the deflections of Euler's beam, whatever the softening (so has it Code_Aster 17.3). They give the
/// exact displacements at the ends of Euler's beams, and of others under a force that does not vary.
Eigen::Matrix<double, 12, 1> end_forces(const BeamInterpolation& beam, const LineLoad& load);

}  // namespace comma::solver
