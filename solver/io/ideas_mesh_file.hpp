// Meshes in universal files of I-DEAS (.unv): data sets of nodes, elements and groups between lines of -1.
#pragma once

#include <string>
#include <string_view>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Nodes (data sets 15, 781, 2411) are numbered as they stand in the file, elements (780, 2412) type by type, lines and
/// faces first, as in Code_Aster 17.3; groups (752, 2417, 2429, 2430, 2432, 2435, 2452, 2467, 2477) make groups of
/// nodes and of cells under their names up to the first blank. Other data sets are passed over. Errors say the line:
/// Error `damaged-mesh`, `unsupported-cell`.
Mesh parse_ideas_mesh(std::string_view text, const std::string& path);
Mesh read_ideas_mesh(const std::string& path);

}  // namespace comma::solver
