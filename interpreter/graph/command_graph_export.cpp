#include "interpreter/graph/command_graph_export.hpp"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "interpreter/graph/graph_reduction.hpp"

namespace comma::interpreter {
namespace {

std::string dot_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string style_of(Need need) {
  switch (need) {
    case Need::verdict:
      return "style=filled, fillcolor=\"#e8f0fe\"";
    case Need::output:
      return "style=dashed";
    case Need::nothing:
      return "color=grey, fontcolor=grey";
  }
  return "";
}

std::string label_of(const CommandNode& node) {
  const std::string concept_name = node.product ? node.product->name + " = " : "";
  const int line = line_of(node);
  return concept_name + node.call.command + (line > 0 ? fmt::format(" (line {})", line) : "");
}

}  // namespace

std::string to_dot(const CommandGraph& graph, Need least) {
  const auto needs = graph.needs();
  std::string out =
      "digraph commands {\n  node [shape=box, fontname=\"sans-serif\"];\n  edge [fontname=\"sans-serif\", "
      "fontsize=10];\n";
  const auto shown = [&](int id) { return needs[static_cast<std::size_t>(id)] >= least; };
  for (const CommandNode& node : graph.nodes()) {
    if (!shown(node.id)) continue;
    const Need need = needs[static_cast<std::size_t>(node.id)];
    fmt::format_to(std::back_inserter(out), "  n{} [label={}, tooltip=\"needed by {}; {}\", {}];\n", node.id,
                   dot_text(label_of(node)), name_of(need), name_of(node.state), style_of(need));
  }
  for (const Arrow& arrow : drawn_arrows(graph)) {
    if (!shown(arrow.from) || !shown(arrow.to)) continue;
    fmt::format_to(std::back_inserter(out), "  n{} -> n{} [label={}{}];\n", arrow.from, arrow.to, dot_text(arrow.label),
                   arrow.carries ? "" : ", style=dotted");
  }
  return out + "}\n";
}

nlohmann::json to_json(const CommandGraph& graph, Need least) {
  const auto needs = graph.needs();
  auto nodes = nlohmann::json::array(), edges = nlohmann::json::array();
  const auto shown = [&](int id) { return needs[static_cast<std::size_t>(id)] >= least; };
  for (const CommandNode& node : graph.nodes()) {
    if (!shown(node.id)) continue;
    nodes.push_back({{"id", node.id},
                     {"command", node.call.command},
                     {"concept", node.product ? nlohmann::json(node.product->name) : nlohmann::json()},
                     {"file", node.call.span ? node.call.span.file->path() : ""},
                     {"line", line_of(node)},
                     {"needed_by", name_of(needs[static_cast<std::size_t>(node.id)])},
                     {"state", name_of(node.state)},
                     {"cost", node.cost == Cost::solve ? "solve" : "cheap"}});
    for (const Edge& edge : node.waits_for) {
      if (!shown(edge.from)) continue;
      edges.push_back(
          {{"from", edge.from}, {"to", node.id}, {"kind", name_of(edge.hazard)}, {"resource", edge.resource}});
    }
  }
  return {{"nodes", nodes}, {"edges", edges}};
}

}  // namespace comma::interpreter
