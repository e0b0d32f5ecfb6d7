#include "solver/linear/aggregation.hpp"

#include <algorithm>
#include <span>

namespace comma::solver {
namespace {

constexpr int none = -1;

std::span<const int> around(const NodeGraph& graph, int node) {
  return {graph.neighbours.data() + graph.starts[node],
          static_cast<std::size_t>(graph.starts[node + 1] - graph.starts[node])};
}

bool is_free(const NodeGraph& graph, const std::vector<int>& taken, int node) {
  return taken[node] == none &&
         std::ranges::all_of(around(graph, node), [&](int other) { return taken[other] == none; });
}

void found_aggregate(const NodeGraph& graph, int node, Aggregates& result) {
  result.of_node[node] = result.count;
  for (const int other : around(graph, node))
    if (result.of_node[other] == none) result.of_node[other] = result.count;
  ++result.count;
}

}  // namespace

Aggregates aggregate(const NodeGraph& graph) {
  Aggregates result{std::vector<int>(static_cast<std::size_t>(graph.size()), none), 0};
  for (int node = 0; node < graph.size(); ++node)
    if (is_free(graph, result.of_node, node)) found_aggregate(graph, node, result);
  const std::vector<int> first_pass = result.of_node;
  for (int node = 0; node < graph.size(); ++node) {
    if (result.of_node[node] != none) continue;
    const auto others = around(graph, node);
    const auto beside = std::ranges::find_if(others, [&](int other) { return first_pass[other] != none; });
    if (beside != others.end()) result.of_node[node] = first_pass[*beside];
  }
  for (int node = 0; node < graph.size(); ++node)
    if (result.of_node[node] == none) found_aggregate(graph, node, result);
  return result;
}

}  // namespace comma::solver
