// Meshes saved by Cast3M as text (SAUVER FORMAT; U7.01.11).
#pragma once

#include <string>
#include <string_view>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Nodes are numbered as the file's points, cells in the order of its elementary objects: those that a named mesh
/// consists of, each cell once however many objects hold it. A named mesh becomes a cell group of its name, one of
/// points a node group, a named point a node group of one node. Errors say line and column: Error `damaged-mesh`,
/// `unsupported-cell`.
Mesh parse_gibi_mesh(std::string_view text, const std::string& path);
Mesh read_gibi_mesh(const std::string& path);

}  // namespace comma::solver
