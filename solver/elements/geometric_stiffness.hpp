// What stresses add to the stiffness of small displacements: the second order of Green and Lagrange's strain times them
// (R7.05.01).
#pragma once

#include <array>
#include <span>

#include "solver/elements/beam_stiffness.hpp"
#include "solver/elements/sparse_pattern.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Section forces in own axes, of the part with greater x upon the part with smaller x.
struct SectionForces {
  double n = 0.0, vy = 0.0, vz = 0.0, mt = 0.0, mfy = 0.0, mfz = 0.0;
};

/// In own axes, of a uniform beam with the forces at its ends; moments go linearly between. With v, w, t the
/// deflections and the torsion of the beam (Euler's or Timoshenko's functions) and b = -w', c = v' where shear does not
/// count, twice the energy is the integral of
///     N (v'^2 + w'^2 + (Iy + Iz) / A t'^2) - 2 My v' t' - 2 Mz w' t' + 2 Vy w' t - 2 Vz v' t + Mt (c b' - b c'),
/// of the section's own displacements, and [t (c My - b Mz)] between the ends, of what rotations have in the second
/// order, so that end moments are semitangential (J. H. Argyris, P. C. Dunne, D. W. Scharpf, CMAME 14, 1978).
BeamMatrix beam_geometric_stiffness(const BeamSection& section, const IsotropicModuli& material, double length,
                                    bool shear, const std::array<SectionForces, 2>& ends);

/// Adds that of like continuum cells from the stresses at their points (cells x points x components), as
/// ElementBlock::stresses() gives them.
void add_continuum_geometric_stiffness(const Mesh& mesh, Formulation formulation, std::span<const int> cells,
                                       const ElementMap& map, std::span<const double> stresses,
                                       std::span<const int> column_starts, double* values);

}  // namespace comma::solver
