// Which facets of cells lie on the boundary of a set of cells, and which cells stand behind a facet.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

#include "solver/mesh/mesh.hpp"

namespace comma::solver {

/// A facet of a cell: boundary_facets(type of the cell)[facet].
struct CellFacet {
  int cell;
  int facet;
};

/// The corners of a facet in rising order, -1 for those that it lacks: the same for the two cells that share it.
using FacetKey = std::array<int, 4>;
struct FacetKeyHash {
  std::size_t operator()(const FacetKey& key) const;
};

FacetKey facet_key(const Mesh& mesh, CellFacet facet);
/// The key that a line or face cell has as a facet of its neighbours.
FacetKey facet_key(const Mesh& mesh, int cell);
/// The nodes of the mesh on a facet, in the facet's order.
std::vector<int> nodes_of_facet(const Mesh& mesh, CellFacet facet);

/// The cells behind each facet.
using FacetMap = std::unordered_map<FacetKey, std::vector<CellFacet>, FacetKeyHash>;
FacetMap map_facets(const Mesh& mesh, std::span<const int> cells);

/// The facets of the cells that just one of them has, cell by cell. Cells without facets (points, lines) have no part
/// in it.
std::vector<CellFacet> boundary_of(const Mesh& mesh, std::span<const int> cells);

/// Positive if the nodes of the cell run in the sense of the reference cell, negative if they run in the other sense:
/// the signed volume of a solid (from its corners), the signed area of a face seen from +z; 0 for points and lines.
double signed_size(const Mesh& mesh, int cell);

}  // namespace comma::solver
