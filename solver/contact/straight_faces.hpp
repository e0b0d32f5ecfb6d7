// Eight-node faces in discrete contact: their edges stay straight, their corners alone make contact (R5.03.50,
// U2.04.04).
//
// A uniform pressure on such a face pulls at its corners, which unilateral conditions would let go. With each middle
// node tied to the ends of its edge, forces reach the corners alone, and all of the same sign.
#pragma once

#include <span>
#include <vector>

#include "solver/contact/definition.hpp"
#include "solver/loads/load.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// The nodes of the slave cells of a zone that may make contact, rising: all but the middle nodes of QUAD8 faces, which
/// straight_edges() ties; of a zone that is watched, all.
std::vector<int> contact_nodes(const Mesh& mesh, const ContactZone& zone);

/// u(middle) = (u(end 1) + u(end 2)) / 2 for each edge of the QUAD8 faces of both surfaces of the zones that are
/// resolved, for the translations that the nodes carry.
std::vector<LinearRelation> straight_edges(const Mesh& mesh, const DofMap& dofs, const ContactDefinition& contact);

}  // namespace comma::solver
