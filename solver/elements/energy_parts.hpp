// What the elastic energy of beams and plates is made of (EPOT_ELEM, ENEL_ELEM; U4.81.04).
#pragma once

#include <array>
#include <string_view>

#include <Eigen/Dense>

#include "solver/elements/section.hpp"

namespace comma::solver {

/// Traction, torsion, bending about the own axes y and z, each with its shear.
inline constexpr std::array<std::string_view, 4> beam_energy_names = {"TRAC_COM", "TORSION", "FLEX_Y", "FLEX_Z"};
/// Of strains of the middle of the plate, of its curvatures, of transverse shear.
inline constexpr std::array<std::string_view, 3> plate_energy_names = {"MEMBRANE", "FLEXION", "CISAILLE"};

/// Half the work of the forces on the ends of a beam (in the axes of the mesh, forces and moments of both ends), part
/// by part. `axes`: its own (rows).
Eigen::Vector4d beam_energy_parts(const BeamSection& section, const Eigen::Matrix3d& axes,
                                  const Eigen::Matrix<double, 12, 1>& displacements,
                                  const Eigen::Matrix<double, 12, 1>& forces);

}  // namespace comma::solver
