// Eight-node faces in discrete contact: their edges stay straight, their corners alone make contact (R5.03.50,
// U2.04.04).
//
// A uniform pressure on such a face pulls at its corners, which unilateral conditions would let go. With each middle
// node tied to the ends of its edge, forces reach the corners alone, and all of the same sign. Where contact does not
// open again (GLISSIERE), or overlaps push back (ALGO_CONT='PENALISATION'), no edge is tied, middle nodes make contact
// as well, and faces are as curved as they are, but it is the corners of the master's that bear (Code_Aster 17.3).
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/definition.hpp"
#include "solver/loads/load.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Whether the edges of QUAD8 faces of a zone are tied: not of one that is watched, that does not open again, or that
/// has a penalty.
bool has_tied_edges(const ContactZone& zone);

/// The nodes of the slave cells of a zone that may make contact, rising: all but the middle nodes that straight_edges()
/// ties.
std::vector<int> contact_nodes(const Mesh& mesh, const ContactZone& zone);

/// Whether a zone has QUAD8 faces.
bool has_straight_faces(const Mesh& mesh, const ContactZone& zone);

/// Where the nodes of the surfaces are for contact: the middle nodes of the QUAD8 faces of a zone that is resolved lie
/// on the straight lines between corners, whatever the mesh has there, so that these faces are bilinear
/// (Code_Aster 17.3).
std::vector<Eigen::Vector3d> straight_positions(const Mesh& mesh, const ContactZone& zone,
                                                std::span<const Eigen::Vector3d> positions);

/// The same for what is interpolated from the nodes of a surface: normals.
void straighten(const Mesh& mesh, std::span<const int> cells, std::unordered_map<int, Eigen::Vector3d>& normals);

/// Shape functions of a QUAD8 face as those of its corners alone; others stay.
void take_corners(CellType type, std::span<double> weights);

/// u(middle) = (u(end 1) + u(end 2)) / 2 for each edge of the QUAD8 faces of both surfaces of the zones that have tied
/// edges, for the translations that the nodes carry.
std::vector<LinearRelation> straight_edges(const Mesh& mesh, const DofMap& dofs, const ContactDefinition& contact);

}  // namespace comma::solver
