// Meshes of Gmsh, text files of the versions 1, 2 and 4 (.msh; Gmsh reference manual, "MSH file format").
#pragma once

#include <string>
#include <string_view>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Nodes and cells have the numbers that Code_Aster 17.3 gives them: nodes in the order of the file, without those that
/// no cell has; cells type by type in the order of Gmsh's numbers of types, and as in the file among each other. The
/// cells of a physical group become the cell group GM<number> (U7.01.31) and, where the physical group has a name, also
/// a group of that name; cells without a physical group are GM0. A QUAD9 becomes a QUAD8 (`kept_type`). Errors say line
/// and column: Error `damaged-mesh`, `unsupported-cell`, `unsupported` for binary files and other versions.
Mesh parse_gmsh_mesh(std::string_view text, const std::string& path);
Mesh read_gmsh_mesh(const std::string& path);

}  // namespace comma::solver
