// Facets that slave points faced when surfaces were last paired, for points that would hop between two of them for
// ever.
#pragma once

#include <cstddef>
#include <vector>

namespace comma::solver {

/// A point keeps its facet while another one is nearer, or it lies beside its facet, by no more than the margin (a
/// share of the facet's size).
struct FacedFacet {
  int facet = -1;       ///< -1: none
  double margin = 0.0;  ///< 0: kept no longer than it is the nearest
};

/// One a slave point or node that is paired again, in the same order, those left out by the user (SANS_GROUP_NO) not
/// counted.
struct FacedFacets {
  std::vector<int> facets;
  double margin = 0.0;

  FacedFacet of(std::size_t point) const {
    return point < facets.size() ? FacedFacet{facets[point], margin} : FacedFacet{};
  }
};

}  // namespace comma::solver
