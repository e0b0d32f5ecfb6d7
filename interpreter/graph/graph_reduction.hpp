// Which arrows of a command graph a picture needs: an arrow that a longer way implies is left out, and several between
// the same two commands become one.
#pragma once

#include <string>
#include <vector>

#include "interpreter/graph/command_graph.hpp"

namespace comma::interpreter {

struct Arrow {
  int from = 0;
  int to = 0;
  std::string label;    ///< the resources, "mesh" or "mesh, model"
  bool carries = true;  ///< false: only an order of writing, nothing is handed over
};

/// The transitive reduction of the graph (A. V. Aho, M. R. Garey, J. D. Ullman, SIAM J. Comput. 1, 1972), in rising
/// order of `to`, then `from`.
std::vector<Arrow> drawn_arrows(const CommandGraph& graph);

}  // namespace comma::interpreter
