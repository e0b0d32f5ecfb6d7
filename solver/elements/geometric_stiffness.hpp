// What stresses add to the stiffness of small displacements: the second order of Green and Lagrange's strain times them
// (R7.05.01).
#pragma once

#include <array>
#include <span>

#include "solver/elements/slender/beam_stiffness.hpp"
#include "solver/elements/sparse_pattern.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Section forces in own axes, of the part with greater x upon the part with smaller x.
struct SectionForces {
  double n = 0.0, vy = 0.0, vz = 0.0, mt = 0.0, mfy = 0.0, mfz = 0.0;
};

/// In own axes, of a uniform beam with the forces at its ends; moments go linearly between. With v and w the
/// deflections (Euler's functions of displacements and rotations, also where shear gives way: so has it
/// Code_Aster 17.3) and t the torsion, twice the energy is the integral of
///     N (v'^2 + w'^2 + (Iy + Iz) / A t'^2) + 2 My t v'' + 2 Mz t w'' + Mt (w' v'' - v' w''),
/// of the section's own displacements, less [t (v' My + w' Mz)] between the ends: what semitangential moments leave
/// (J. H. Argyris, P. C. Dunne, D. W. Scharpf, CMAME 14, 1978). In a beam whose length changes from step to step L Vz
/// is not quite the difference of My between the ends (nor -L Vy that of Mz): what it is more acts between the
/// differences of torsion and of rotation, as in Code_Aster 17.3.
BeamMatrix beam_geometric_stiffness(const BeamSection& section, double length,
                                    const std::array<SectionForces, 2>& ends);

/// Adds that of like continuum cells from the stresses at their points (cells x points x components), as
/// ElementBlock::stresses() gives them.
void add_continuum_geometric_stiffness(const Mesh& mesh, Formulation formulation, std::span<const int> cells,
                                       const ElementMap& map, std::span<const double> stresses,
                                       std::span<const int> column_starts, double* values);

}  // namespace comma::solver
