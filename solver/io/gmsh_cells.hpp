// Gmsh's names for cells (its reference manual, "Node ordering" and "MSH file format").
#pragma once

#include <vector>

#include "solver/mesh/cell_type.hpp"

namespace comma::solver {

/// Gmsh's number of a cell type, and at which of Gmsh's places the nodes stand that Code_Aster lists one after the
/// other; empty where the two agree.
struct GmshType {
  int number;
  CellType type;
  std::vector<int> order = {};
};

/// What LIRE_MAILLAGE makes of a cell: Code_Aster leaves the nodes inside faces and cells out (QUAD9 becomes QUAD8:
/// ssnp152g tells; HEXA27 and PENTA18, whose faces are such, HEXA20 and PENTA15). The first nodes of either are the
/// same.
CellType without_inner_nodes(CellType type);

/// All that both know.
const std::vector<GmshType>& gmsh_types();

}  // namespace comma::solver
