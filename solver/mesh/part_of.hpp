// Which nodes and cells of a mesh those of a part of it are (EXTR_RESU, RESTREINT; U4.71.04).
#pragma once

#include <vector>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// The node and the cell of the whole that each of the part is.
struct PartOfMesh {
  std::vector<int> nodes, cells;
};

/// A part keeps the places of nodes, digit by digit, and the order of cells: of cells of one type whose nodes lie at
/// the same places those of the part are the first ones of the whole. Throws Error `not-a-part` naming a cell or node
/// that the whole does not have.
PartOfMesh part_of(const Mesh& whole, const Mesh& part);

}  // namespace comma::solver
