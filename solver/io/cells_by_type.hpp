// Cells of files whose cells Code_Aster numbers type by type.
#pragma once

#include <span>
#include <vector>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// A cell as a file lists it.
struct ListedCell {
  int rank = 0;  ///< of its type among the others
  CellType type = CellType::poi1;
  std::vector<int> nodes;
};

/// Adds cells in rising order of their ranks, those of one rank as they are listed. Their indices in the mesh, one a
/// listed cell.
std::vector<int> add_by_rank(std::span<const ListedCell> cells, Mesh& mesh);

}  // namespace comma::solver
