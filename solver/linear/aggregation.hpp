// Groups of strongly connected nodes: the coarse unknowns of algebraic multigrid.
#pragma once

#include <vector>

namespace comma::solver {

/// Neighbours of each node, without the node itself: those of node i are numbers starts[i] .. starts[i + 1] - 1.
struct NodeGraph {
  std::vector<int> starts = {0};
  std::vector<int> neighbours;

  int size() const { return static_cast<int>(starts.size()) - 1; }
};

struct Aggregates {
  std::vector<int> of_node;  ///< the aggregate of each node
  int count = 0;
};

/// Every node in one aggregate: a node and all its neighbours where none is taken yet, the rest joined to an aggregate
/// beside them (Vanek, Mandel, Brezina, "Algebraic multigrid by smoothed aggregation for second and fourth order
/// elliptic problems", Computing 56, 1996, section 5). A node without neighbours is an aggregate of its own.
Aggregates aggregate(const NodeGraph& graph);

}  // namespace comma::solver
