// Cells of which a mesh has more than one, and cells that have a node more than once.
#pragma once

#include <vector>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

struct RepeatedCell {
  int first;  ///< the first cell of the type on these nodes
  int again;  ///< one more of it, whose nodes may stand in another order
};

/// All cells that repeat an earlier one, rising (U4.21.01, VERI_MAIL). Points do not count: discrete elements beside
/// each other are made of them.
std::vector<RepeatedCell> repeated_cells(const Mesh& mesh);

/// Cells that have one of their nodes more than once, rising.
std::vector<int> collapsed_cells(const Mesh& mesh);

}  // namespace comma::solver
