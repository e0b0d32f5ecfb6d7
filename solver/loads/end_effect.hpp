// The pull of a pressurised tube's missing end (U4.44.01, EFFE_FOND).
#pragma once

#include <span>
#include <vector>

#include "solver/loads/load.hpp"
#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// Area that a closed line encloses: edges (in any order, turned any way) that make one or several closed lines round
/// the same hole. It is that of the plane best fitted to the line: half the length of the sum of x cross dx. Edges
/// of three nodes are two straight ones. Throws Error `not-a-line` for a cell that is no edge, and for a line that is
/// open or forks (naming a node).
double enclosed_area(const Mesh& mesh, std::span<const int> rim);

/// Length of edges, those of three nodes being two straight ones.
double length_along_nodes(const Mesh& mesh, std::span<const int> rim);

/// Area of face cells. Throws Error `not-a-face` naming a cell that is none.
double surface_area(const Mesh& mesh, std::span<const int> faces);

/// Pressures on the faces of the cut end whose resultant is that of `pressure` on the hole inside `rim`: the faces are
/// pulled outwards with pressure * enclosed_area / surface_area. With a function, it replaces `pressure`.
std::vector<PressureLoad> end_effect(const Mesh& mesh, std::span<const int> faces, std::span<const int> rim,
                                     double pressure, const FieldFunction& function = {});

}  // namespace comma::solver
