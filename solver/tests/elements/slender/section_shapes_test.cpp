#include "solver/elements/slender/section_shapes.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using std::numbers::pi;

namespace {

/// Torsion constant of a solid rectangle a x b by Saint-Venant's series (Timoshenko and Goodier, art. 109).
double saint_venant(double a, double b) {
  double sum = 0.0;
  for (int n = 1; n < 40; n += 2) sum += std::tanh(n * pi * a / (2 * b)) / std::pow(n, 5);
  return a * b * b * b / 3.0 * (1.0 - 192.0 / std::pow(pi, 5) * b / a * sum);
}

}  // namespace

TEST_CASE("a solid rectangle has b h^3 / 12 and nearly Saint-Venant's torsion constant", "[elements]") {
  for (const double y : {0.1, 0.2, 1.0}) {
    const BeamSection section = rectangular_section({.height_y = y, .height_z = 0.2});
    CHECK(section.area == exactly(0.2 * y));
    CHECK(section.inertia_y == exactly(y * 0.008 / 12));
    CHECK(section.inertia_z == exactly(0.2 * y * y * y / 12));
    CHECK(section.torsion == Approx(saint_venant(std::max(y, 0.2), std::min(y, 0.2))).epsilon(5e-3));
    CHECK(section.shear_y == 1.2);
    CHECK(section.reach_y == y / 2);
    CHECK(section.reach_z == 0.1);
  }
}

TEST_CASE("a hollow section is the outer one without the inner", "[elements]") {
  const BeamSection box = rectangular_section({0.3, 0.2, 0.02, 0.01});
  const BeamSection outer = rectangular_section({.height_y = 0.3, .height_z = 0.2});
  const BeamSection inner = rectangular_section({.height_y = 0.26, .height_z = 0.18});
  CHECK(box.area == exactly(outer.area - inner.area));
  CHECK(box.inertia_y == exactly(outer.inertia_y - inner.inertia_y));
  CHECK(box.inertia_z == exactly(outer.inertia_z - inner.inertia_z));
  const BeamSection tube = circular_section(0.1, 0.03);
  CHECK(tube.area == exactly(pi * (0.01 - 0.0049)));
  CHECK(tube.inertia_y == exactly(pi / 4 * (1e-4 - 0.0049 * 0.0049)));
  CHECK(tube.torsion == exactly(2 * tube.inertia_y));
  CHECK(circular_section(0.1, 0.1).shear_y == Approx(7.0 / 6.0).epsilon(1e-5));
}

TEST_CASE("thin walls twist as Bredt says and shear over twice their area", "[elements]") {
  const double wall = 1e-4;
  const BeamSection box = rectangular_section({0.2, 0.2, wall, wall});
  CHECK(box.torsion == Approx(wall * 0.2 * 0.2 * 0.2).epsilon(2e-3));
  const BeamSection tube = circular_section(0.1, wall);
  CHECK(tube.torsion == Approx(2 * pi * 1e-3 * wall).epsilon(2e-3));
  CHECK(tube.shear_y == Approx(2.0).epsilon(1e-5));
  // Unequal walls: the stress is that of the walls across z, the thinner ones or not.
  const BeamSection unequal = rectangular_section({0.2, 0.2, wall, 2 * wall});
  CHECK(unequal.torsion / unequal.torsion_reach == Approx(2 * 0.2 * 0.2 * 2 * wall).epsilon(4e-3));
}

TEST_CASE("an elbow is softer in bending by its factors, and not in torsion", "[elements]") {
  const BeamSection pipe = circular_section(0.1, 0.01);
  const BeamSection elbow = softened(pipe, 2.0, 4.0);
  CHECK(elbow.inertia_z == pipe.inertia_z / 2.0);
  CHECK(elbow.inertia_y == pipe.inertia_y / 4.0);
  CHECK(elbow.torsion == pipe.torsion);
}

TEST_CASE("sections that cannot be are refused", "[elements]") {
  CHECK_THROWS_WITH(circular_section(0.1, 0.2), Catch::Contains("radius 0.1 cannot have a wall of 0.2"));
  CHECK_THROWS_AS(circular_section(-0.1, 0.1), Error);
  CHECK_THROWS_AS(rectangular_section({0.0, 0.2, 0.0, 0.0}), Error);
  CHECK_THROWS_WITH(rectangular_section({0.2, 0.2, 0.2, 0.01}), Catch::Contains("no hole"));
  CHECK_THROWS_AS(softened(circular_section(0.1, 0.1), 0.0, 1.0), Error);
}
