// Distributed loads on bars and beams as forces and moments at their ends.
#pragma once

#include <span>

#include <Eigen/Dense>

#include "solver/elements/external_forces.hpp"
#include "solver/elements/slender/beam_interpolation.hpp"
#include "solver/materials/elasticity.hpp"

namespace comma::solver {

/// Own axes (rows) of a bar or beam, its roll included.
Eigen::Matrix3d slender_axes(const ForceInput& input, int cell);
/// Throws Error `missing-properties` naming a cell without cross-section.
const BeamSection& section_of(const ForceInput& input, int cell);
/// Throws Error `missing-material` naming a cell without elastic material.
const Elasticity& elasticity_of(const ForceInput& input, int cell);
/// What the material knows on the mean of a cell.
MaterialPoint material_point_of(const ForceInput& input, int cell);

/// Adds to the degrees of freedom of a bar or beam the end forces (own axes, N VY VZ MT MFY MFZ at each end) that do
/// the work of a load per length. A bar shares its load as its linear interpolation does; so does a beam whose section
/// varies as a uniform one does with the section of its middle, which is not exact (R3.08.01): it takes several of
/// them. Throws Error `unsupported` for moments on a bar.
void add_slender_load(const ForceInput& input, int cell, const LineLoad& load, std::span<long double> forces);

/// The same of a force per length that is given at both ends: linear between them, but on a beam whose section varies
/// each end bears its own as if that were constant (so has it Code_Aster 17.3).
void add_force_per_length(const ForceInput& input, int cell, const std::array<Eigen::Matrix<double, 6, 1>, 2>& at_ends,
                          std::span<long double> forces);

}  // namespace comma::solver
