// Meshes saved by Cast3M as text (SAUVER FORMAT; U7.01.11).
#pragma once

#include <string>
#include <string_view>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Nodes are numbered as the places that points have among the coordinates, cells in the order of the elementary
/// objects that a named mesh consists of; a cell that several objects hold, its nodes in one order, is one cell. A
/// named mesh becomes a cell group of its name (of POI1 where it is one of points), a named point a node group of one
/// node. So it is in Code_Aster 17.3. Errors say line and column: Error `damaged-mesh`, `unsupported-cell`.
Mesh parse_gibi_mesh(std::string_view text, const std::string& path);
Mesh read_gibi_mesh(const std::string& path);

}  // namespace comma::solver
