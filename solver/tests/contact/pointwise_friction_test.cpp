#include <catch2/catch.hpp>

#include "solver/tests/contact/coupled_points.hpp"

using namespace comma::solver;

TEST_CASE("Friction on a round patch that turns as it is pressed settles in a few iterations, whatever the augmentation") {
  constexpr int edge = 12;
  for (const double augmentation : {1.0, 10.0, 100.0}) {
    CoupledSurface surface(edge);
    for (int p = 0; p < edge * edge; ++p) {
      const double x = (p % edge + 0.5) / edge - 0.5, y = (p / edge + 0.5) / edge - 0.5;
      CondensedPoint& point = surface.problem.points[static_cast<std::size_t>(p)];
      point.law.friction = 0.2;
      point.law.augmentation *= augmentation;
      point.law.friction_augmentation *= augmentation;
      surface.problem.free.segment<3>(3 * p) << -0.5 + 4.0 * (x * x + y * y), 0.2 * (0.3 + 2.0 * x * x - y), 0.2 * (y * y - 2.0 * x);
    }
    const CondensedSolution solution = solve_condensed(surface.schur, surface.problem, surface.state);
    REQUIRE(solution.verdict == CondensedVerdict::solved);
    CHECK(solution.iterations <= 15);
    CHECK(surface.counts() == std::array{112, 28, 4});  // open, sliding, sticking
  }
}
