// Names that the syntax cannot judge: groups, nodes, cells, components, fields and parameters, looked up in the meshes
// and models that a call reaches through its concepts (a result reads its model, the model its mesh). Every call is
// looked at, also one that `comma check` will not run.
#pragma once

#include "interpreter/catalogue/catalogue.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/command_graph.hpp"

namespace comma::commands {

/// Reports what is wrong in a call whose turn in the file has come: unknown-group, unknown-node, unknown-cell,
/// unknown-component, unknown-field, unknown-parameter, once for each value. What cannot be known (the groups of a mesh
/// that a command changes which comma does not run) is not judged.
/// Returns whether the call may run.
bool check_names(const interpreter::CommandNode& node, const interpreter::CommandGraph& graph,
                 const interpreter::Catalogue& catalogue, interpreter::Diagnostics& diagnostics);

}  // namespace comma::commands
