#include "interpreter/graph/graph_reduction.hpp"

#include <map>

namespace comma::interpreter {
namespace {

/// One arrow a predecessor, with all that it hands over.
std::map<int, Arrow> merged_arrows(const CommandNode& node) {
  std::map<int, Arrow> arrows;
  for (const Edge& edge : node.waits_for) {
    Arrow& arrow = arrows.try_emplace(edge.from, Arrow{edge.from, node.id, "", false}).first->second;
    arrow.carries |= edge.hazard == Hazard::read_after_write;
    if ((", " + arrow.label + ",").find(", " + edge.resource + ",") != std::string::npos) continue;
    arrow.label += (arrow.label.empty() ? "" : ", ") + edge.resource;
  }
  return arrows;
}

}  // namespace

// Nodes come in an order in which each follows what it waits for, so its ancestors are known when it is met.
std::vector<Arrow> drawn_arrows(const CommandGraph& graph) {
  const std::size_t count = graph.nodes().size();
  std::vector<std::vector<bool>> ancestors(count, std::vector<bool>(count, false));
  std::vector<Arrow> drawn;
  for (const CommandNode& node : graph.nodes()) {
    const auto arrows = merged_arrows(node);
    auto& above = ancestors[static_cast<std::size_t>(node.id)];
    std::vector<bool> implied(count, false);
    for (const auto& [from, arrow] : arrows) {
      for (std::size_t i = 0; i < count; ++i) {
        if (ancestors[static_cast<std::size_t>(from)][i]) implied[i] = above[i] = true;
      }
      above[static_cast<std::size_t>(from)] = true;
    }
    for (const auto& [from, arrow] : arrows) {
      if (!implied[static_cast<std::size_t>(from)]) drawn.push_back(arrow);
    }
  }
  return drawn;
}

}  // namespace comma::interpreter
