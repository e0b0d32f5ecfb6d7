// The command graph for other eyes: Graphviz' dot language, and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "interpreter/graph/command_graph.hpp"

namespace comma::interpreter {

/// A digraph, reduced to the arrows that no longer way implies: boxes are commands with their concept and line, arrows
/// are concepts and files. What a verdict needs is drawn solid, what only an output needs dashed, the rest grey; each
/// says so in its tooltip. Nodes that are needed less than `least` are left out.
std::string to_dot(const CommandGraph& graph, Need least = Need::nothing);

/// {"nodes": [{"id", "command", "concept", "file", "line", "needed_by", "state", "cost"}],
///  "edges": [{"from", "to", "kind": "raw|war|waw", "resource"}]}
nlohmann::json to_json(const CommandGraph& graph, Need least = Need::nothing);

}  // namespace comma::interpreter
