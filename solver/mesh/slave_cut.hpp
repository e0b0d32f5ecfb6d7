// Slave faces cut into patches for local average contact (CREA_MAILLAGE, DECOUPE_LAC; U4.23.02, R5.03.55).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// How a hexahedron behind a slave face is cut: into five pyramids that meet at the centre of the face, or into six
/// hexahedra.
enum class HexaCut : std::uint8_t { pyramids, hexahedra };

/// The mesh with a node of its own inside each of the faces (lines in the plane): the method needs a displacement
/// inside each patch that moves no other one. A face that has such a node (SEG3, TRIA7, QUAD9) stays whole. Of another
/// one the pieces go from the edges to the new node at its centre, and those of the body behind it from all its other
/// facets, so that no other body changes; nodes inside faces and bodies lie where the shape functions carry them. A
/// line before a QUAD4 is cut into thirds, and the QUAD4 into four around one below the middle third, as
/// HexaCut::hexahedra does in space (ssnv104m, to 1e-8). Cells on the same facet are cut alike. The pieces take the
/// place of what was cut, one after the other (so cells have the numbers of Code_Aster 17.3), and enter its groups; the
/// first has its name. Each of the faces becomes an entry of `slave_patches`. Throws Error `no-body` for a face with no
/// body behind it, `inner-face` for one between two, `unsupported` for bodies without a cut: PENTA18, HEXA27 behind
/// faces without a centre, quadratic ones for HexaCut::hexahedra.
Mesh with_cut_slave_faces(const Mesh& mesh, std::span<const int> faces, HexaCut hexa_cut);

/// The nodes inside a patch that its pressure belongs to, rising: the corners of its faces that are on none of the
/// edges (ends, of lines) that just one of them has; of one whole face the node in its middle.
std::vector<int> inner_nodes(const Mesh& mesh, std::span<const int> patch);

}  // namespace comma::solver
