#include "solver/mesh/cell_type.hpp"

#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "reference_cells.hpp"

using namespace comma::solver;
using comma::solver::tests::Vector;

namespace {

std::vector<CellType> all_types() {
  std::vector<CellType> types;
  for (int i = 0; i < cell_type_count; ++i) types.push_back(static_cast<CellType>(i));
  return types;
}

}  // namespace

TEST_CASE("every cell type is found by its own name") {
  for (const CellType type : all_types()) {
    CHECK(cell_type_named(name_of(type)) == type);
    CHECK(corner_count(type) <= node_count(type));
  }
  CHECK_FALSE(cell_type_named("HEXA9").has_value());
  CHECK_FALSE(cell_type_named("").has_value());
}

TEST_CASE("the facets of a solid close it and point outwards") {
  for (const CellType type : all_types()) {
    if (dimension(type) != 3) continue;
    INFO(name_of(type));
    const auto points = tests::reference_nodes(type);
    Vector closed = Vector::Zero();
    double volume = 0.0;
    for (const BoundaryFacet& facet : boundary_facets(type)) {
      const Vector area = tests::area_vector(points, facet);
      closed += area;
      volume += area.dot(tests::corner_mean(points, facet)) / 3.0;
      CHECK(area.dot(tests::corner_mean(points, facet) - tests::corner_mean(points, corner_count(type))) > 0.0);
    }
    // Flat faces whose corner mean is their centroid: the divergence theorem is exact up to rounding.
    CHECK(closed.norm() == Approx(0.0).margin(1e-14));
    CHECK(volume == Approx(tests::reference_volume(type)).epsilon(1e-14));
  }
}

TEST_CASE("the edges of a face cell go round it counter-clockwise") {
  for (const CellType type : all_types()) {
    if (dimension(type) != 2) continue;
    INFO(name_of(type));
    const auto points = tests::reference_nodes(type);
    double twice_area = 0.0;
    Vector closed = Vector::Zero();
    for (const BoundaryFacet& facet : boundary_facets(type)) {
      const Vector a = points[facet.nodes[0]];
      const Vector b = points[facet.nodes[1]];
      closed += b - a;
      twice_area += a.x() * b.y() - a.y() * b.x();
    }
    CHECK(closed.norm() == Approx(0.0).margin(1e-14));
    CHECK(twice_area / 2.0 == Approx(tests::reference_volume(type)).epsilon(1e-14));
  }
}

TEST_CASE("middle nodes of facets lie in the middle of their edges and faces") {
  for (const CellType type : all_types()) {
    const auto points = tests::reference_nodes(type);
    for (const BoundaryFacet& facet : boundary_facets(type)) {
      INFO(name_of(type));
      const int corners = corner_count(facet.type);
      const int edges = dimension(facet.type) == 1 ? 1 : corners;
      for (int i = corners; i < node_count(facet.type); ++i) {
        const Vector expected =
            i - corners < edges
                ? Vector(0.5 * (points[facet.nodes[i - corners]] + points[facet.nodes[(i - corners + 1) % corners]]))
                : tests::corner_mean(points, facet);
        CHECK((points[facet.nodes[i]] - expected).norm() == Approx(0.0).margin(1e-14));
      }
    }
  }
}

TEST_CASE("every node of a solid but its centre lies on a facet") {
  for (const CellType type : all_types()) {
    if (dimension(type) != 3) continue;
    std::set<int> seen;
    for (const BoundaryFacet& facet : boundary_facets(type)) {
      for (int i = 0; i < node_count(facet.type); ++i) seen.insert(facet.nodes[i]);
    }
    CHECK(static_cast<int>(seen.size()) == node_count(type) - (type == CellType::hexa27 ? 1 : 0));
  }
}
