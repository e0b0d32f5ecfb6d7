// What fuzz targets ask of a mesh that a reader has let through.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "solver/mesh/mesh.hpp"

namespace comma::solver::fuzz {

/// Ends the program, which is how a fuzz target tells of a find.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

inline void require_indices(const std::vector<int>& indices, int count, const char* what) {
  require(std::ranges::all_of(indices, [&](int index) { return index >= 0 && index < count; }), what);
}

/// Every index of the mesh points at something, and every coordinate is a number.
inline void require_sound(const Mesh& mesh) {
  require(mesh.node_count() > 0, "there are nodes");
  require(mesh.dimension == 2 || mesh.dimension == 3, "the dimension is 2 or 3");
  for (const Point& node : mesh.nodes) {
    require(std::ranges::all_of(node, [](double x) { return std::isfinite(x); }), "coordinates are finite");
  }
  require_indices(mesh.connectivity, mesh.node_count(), "cells refer to nodes");
  for (const auto& [name, nodes] : mesh.node_groups) require_indices(nodes, mesh.node_count(), "groups refer to nodes");
  for (const auto& [name, cells] : mesh.cell_groups) require_indices(cells, mesh.cell_count(), "groups refer to cells");
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto type = mesh.cell_types[static_cast<std::size_t>(cell)];
    require(static_cast<int>(mesh.cell(cell).size()) == node_count(type), "a cell has the nodes of its type");
  }
}

/// Coordinates, cells and groups are the same.
inline void require_same(const Mesh& a, const Mesh& b) {
  require(a.dimension == b.dimension && a.nodes == b.nodes, "nodes come back as they were");
  require(a.cell_types == b.cell_types && a.connectivity == b.connectivity, "cells come back as they were");
  require(a.node_groups == b.node_groups && a.cell_groups == b.cell_groups, "groups come back as they were");
}

}  // namespace comma::solver::fuzz
