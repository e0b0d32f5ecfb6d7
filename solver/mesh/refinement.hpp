// Cutting all cells into smaller ones of their kind (CREA_MAILLAGE, RAFFINEMENT; U4.23.02).
#pragma once

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Lines into halves, triangles and quadrangles into four, solids into eight, with new nodes in the middle of edges,
/// quadrangular faces and hexahedra; a tetrahedron is cut inside along the line from the middle of its third edge to
/// that of its fifth. Pieces have as many nodes as their cell: those that it has itself, and new ones where its shape
/// functions put them, but for edges and faces of pieces within a solid, which are straight. Pieces stand in the place
/// of their cell and in its groups; groups of nodes stay. Throws Error `unsupported` naming a cell that is a pyramid.
Mesh refined(const Mesh& mesh);

}  // namespace comma::solver
