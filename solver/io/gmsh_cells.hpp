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

/// What LIRE_MAILLAGE makes of a cell: Code_Aster 17.3 leaves the node inside a QUAD9 out, which becomes a QUAD8 of its
/// first nodes, and keeps those of HEXA27 and PENTA18.
CellType kept_type(CellType type);

/// All that both know.
const std::vector<GmshType>& gmsh_types();

}  // namespace comma::solver
