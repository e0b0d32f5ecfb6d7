// Whether what a command is given lies on one mesh.
#pragma once

#include "interpreter/graph/call.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::commands {

/// Throws DiagnosticError `other-mesh` where what the keyword names lies on a mesh that is not `mesh`. No mesh: nothing
/// is known, and nothing is thrown.
void require_mesh(const interpreter::Keywords& keywords, const char* keyword, const solver::Mesh* own,
                  const solver::Mesh& mesh);

}  // namespace comma::commands
