#include "solver/loads/end_effect.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

/// A ring in a slanted plane through (5, 6, 7): `count` quadrangles QUAD4 or QUAD8 between two radii, their inner edges
/// turned to and fro.
struct Ring {
  Ring(int count, bool quadratic) {
    const Eigen::Vector3d centre(5, 6, 7), a(0, 0.6, 0.8), b(1, 0, 0);
    const int steps = quadratic ? 2 * count : count;
    for (const double radius : {1.0, 1.5, 2.0}) {
      for (int k = 0; k < steps; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / steps;
        const Eigen::Vector3d x = centre + radius * (std::cos(angle) * a + std::sin(angle) * b);
        mesh.nodes.push_back({x[0], x[1], x[2]});
      }
    }
    const int outer = 2 * steps;
    for (int k = 0; k < count; ++k) {
      const int i = quadratic ? 2 * k : k, j = (i + (quadratic ? 2 : 1)) % steps, m = i + 1;
      if (quadratic)
        faces.push_back(mesh.add_cell(CellType::quad8,
                                      std::vector{i, i + outer, j + outer, j, i + steps, m + outer, j + steps, m}));
      else
        faces.push_back(mesh.add_cell(CellType::quad4, std::vector{i, i + outer, j + outer, j}));
    }
    for (int k = 0; k < count; ++k) {
      const int i = quadratic ? 2 * k : k, j = (i + (quadratic ? 2 : 1)) % steps;
      const std::vector<int> ends = k % 3 == 0 ? std::vector{j, i} : std::vector{i, j};
      if (quadratic)
        rim.push_back(mesh.add_cell(CellType::seg3, std::vector{ends[0], ends[1], i + 1}));
      else
        rim.push_back(mesh.add_cell(CellType::seg2, ends));
    }
  }

  Mesh mesh;
  std::vector<int> faces, rim;
};

double polygon(int sides) { return 0.5 * sides * std::sin(2.0 * std::numbers::pi / sides); }

}  // namespace

TEST_CASE("the area inside a rim: a polygon by straight edges, whichever way they are turned") {
  const Ring ring(12, false);
  CHECK(enclosed_area(ring.mesh, ring.rim) == exactly(polygon(12)));
  CHECK(surface_area(ring.mesh, ring.faces) == exactly(3.0 * polygon(12)));
  CHECK(length_along_nodes(ring.mesh, ring.rim) == exactly(24.0 * std::sin(std::numbers::pi / 12)));
}

TEST_CASE("a rim of quadratic edges is a polygon through their middle nodes too") {
  const Ring ring(12, true);
  CHECK(enclosed_area(ring.mesh, ring.rim) == exactly(polygon(24)));
  CHECK(length_along_nodes(ring.mesh, ring.rim) == exactly(48.0 * std::sin(std::numbers::pi / 24)));
}

TEST_CASE("the end of a tube is pulled by the pressure on its hole") {
  const Ring ring(12, false);
  const auto loads = end_effect(ring.mesh, ring.faces, ring.rim, 60.0);
  REQUIRE(loads.size() == 12);
  for (const auto& load : loads) CHECK(load.pressure == exactly(-60.0 / 3.0));
  const auto changing =
      end_effect(ring.mesh, ring.faces, ring.rim, 0.0, [](const Point&, double t) { return 6.0 * t; });
  CHECK(changing[3].pressure_function({}, 2.0) == exactly(-4.0));
}

TEST_CASE("a rim that is open, forks or is no line is refused") {
  Ring ring(12, false);
  std::vector<int> open(ring.rim.begin(), ring.rim.end() - 1);
  CHECK_THROWS_WITH(enclosed_area(ring.mesh, open), Catch::Contains("ends at node"));
  std::vector<int> forked = ring.rim;
  forked.push_back(ring.mesh.add_cell(CellType::seg2, std::vector{0, 5}));
  CHECK_THROWS_WITH(enclosed_area(ring.mesh, forked), Catch::Contains("forks at node"));
  CHECK_THROWS_WITH(enclosed_area(ring.mesh, ring.faces), Catch::Contains("no edge"));
  CHECK_THROWS_WITH(surface_area(ring.mesh, ring.rim), Catch::Contains("no face"));
}
