#include "solver/elements/slender/shear_coefficient.hpp"

#include <cmath>
#include <utility>

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

/// Of thin walls, by Cowper (The shear coefficient in Timoshenko's beam theory, 1966) for a Poisson's ratio of 0.
double thin(double y, double z, double web, double flange) {
  const double n = y / z, m = y * flange / (z * web);
  return (12 + 72 * m + 150 * m * m + 90 * m * m * m + 30 * n * n * (m + m * m)) / (10 * (1 + 3 * m) * (1 + 3 * m));
}

HollowRectangle walls(double y, double z, double web, double flange) {
  return {(y + web) / 2, (z + flange) / 2, (y - web) / 2, (z - flange) / 2};
}

}  // namespace

TEST_CASE("a hollow rectangle shears as Cowper says where its walls are thin", "[elements]") {
  for (const auto& [y, z] : {std::pair(1.0, 1.0), std::pair(0.5, 1.0), std::pair(2.0, 1.0)}) {
    for (const double ratio : {0.5, 1.0, 3.0}) {
      CAPTURE(y, z, ratio);
      const double wall = 2e-3;
      const double far = shear_coefficient_along_z(walls(y, z, wall, ratio * wall)) - thin(y, z, wall, ratio * wall),
                   near = shear_coefficient_along_z(walls(y, z, wall / 2, ratio * wall / 2)) -
                          thin(y, z, wall / 2, ratio * wall / 2);
      CHECK(std::abs(far) < 0.03);
      CHECK(near / far == Approx(0.5).margin(0.1));  // what is left goes with the walls
    }
  }
}

TEST_CASE("a hollow rectangle with a small hole shears as a solid one", "[elements]") {
  CHECK(shear_coefficient_along_z({1.0, 1.0, 1e-3, 1e-3}) == Approx(1.2).epsilon(1e-5));
  CHECK(shear_coefficient_along_z({1.0, 3.0, 1e-3, 1e-3}) == Approx(1.2).epsilon(1e-5));
}

TEST_CASE("the shear coefficient does not know units", "[elements]") {
  CHECK(shear_coefficient_along_z({50.0, 100.0, 40.0, 90.0}) ==
        Approx(shear_coefficient_along_z({0.05, 0.1, 0.04, 0.09})).epsilon(1e-8));
}
