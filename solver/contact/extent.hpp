// How large a piece of a surface is.
#pragma once

#include <span>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// The diagonal of the box that holds the cells before deformation (m).
double extent(const Mesh& mesh, std::span<const int> cells);
/// Of all nodes.
double extent(const Mesh& mesh);
inline double extent(const Mesh& mesh, int cell) { return extent(mesh, std::span(&cell, 1)); }

}  // namespace comma::solver
