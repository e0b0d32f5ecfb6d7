// Meshes in Code_Aster's own text format (.mail), U3.01.00.
#pragma once

#include <string>
#include <string_view>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Parses the text of a .mail file; `path` is for messages. Errors say line and column: Error `damaged-mesh`,
/// `unsupported-cell`, `unknown-node`.
Mesh parse_aster_mesh(std::string_view text, const std::string& path);
Mesh read_aster_mesh(const std::string& path);
std::string format_aster_mesh(const Mesh& mesh);

}  // namespace comma::solver
