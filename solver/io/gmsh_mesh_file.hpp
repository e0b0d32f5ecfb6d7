// Meshes of Gmsh, text files of the versions 1, 2 and 4 (.msh; Gmsh reference manual, "MSH file format").
#pragma once

#include <string>
#include <string_view>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Nodes and cells keep their numbers: N12, M34. The cells of a physical group become the cell group GM<number>
/// (U7.01.31) and, where the physical group has a name, also a group of that name. Nodes inside faces and cells of
/// second order belong to no cell
/// (`without_inner_nodes`). Errors say line and column: Error `damaged-mesh`,
/// `unsupported-cell`, `unsupported` for binary files and other versions.
Mesh parse_gmsh_mesh(std::string_view text, const std::string& path);
Mesh read_gmsh_mesh(const std::string& path);

}  // namespace comma::solver
