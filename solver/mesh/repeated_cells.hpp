// Cells that a mesh holds twice, as two bodies saved on each other leave them.
#pragma once

#include <vector>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

struct RepeatedCell {
  int first;  ///< the first cell of the type on these nodes
  int again;  ///< one more of it, whose nodes may stand in another order
};

/// All cells that repeat an earlier one, rising (U4.21.01, VERI_MAIL). Points do not count: discrete elements beside each other are made of them.
std::vector<RepeatedCell> repeated_cells(const Mesh& mesh);

}  // namespace comma::solver
