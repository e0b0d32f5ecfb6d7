// What the elastic energy of beams and plates is made of (EPOT_ELEM, ENEL_ELEM; U4.81.04).
#pragma once

#include <array>
#include <string_view>

#include <Eigen/Dense>

#include "solver/elements/slender/section.hpp"

namespace comma::solver {

/// Traction, torsion, bending about the own axes y and z, each with its shear.
inline constexpr std::array<std::string_view, 4> beam_energy_names = {"TRAC_COM", "TORSION", "FLEX_Y", "FLEX_Z"};
/// Of strains of the surface of the mesh, of curvatures, of transverse shear, and of the first two together where the
/// middle of the plate lies apart from that surface.
inline constexpr std::array<std::string_view, 4> plate_energy_names = {"MEMBRANE", "FLEXION", "CISAILLE", "COUPL_MF"};

/// Half the work of the forces on the ends of a beam (in the axes of the mesh, forces and moments of both ends), part
/// by part. `axes`: its own (rows).
Eigen::Vector4d beam_energy_parts(const BeamSection& section, const Eigen::Matrix3d& axes,
                                  const Eigen::Matrix<double, 12, 1>& displacements,
                                  const Eigen::Matrix<double, 12, 1>& forces);

}  // namespace comma::solver
