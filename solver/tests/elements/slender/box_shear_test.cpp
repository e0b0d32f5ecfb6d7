#include "solver/elements/slender/box_shear.hpp"

#include <catch2/catch.hpp>

#include "solver/elements/slender/shear_coefficient.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

TEST_CASE("boxes shear as square ones do by the energy of their stresses", "[elements]") {
  for (const double along : {0.1, 0.5, 0.8, 0.95})
    for (const double across : {0.1, 0.3, 0.7, 0.95})
      CHECK(*box_shear(along, across) == Approx(shear_coefficient_along_z({1.0, 1.0, across, along})).epsilon(3.1e-3));
}

TEST_CASE("shear of boxes is linear between ratios of inner to outer sides", "[elements]") {
  // 0.2 by 0.4 with walls of 0.02 and 0.03, from stresses of Code_Aster 17.3.
  CHECK(*box_shear(0.8, 0.85) == exactly(2.79151));
  CHECK(*box_shear(0.85, 0.8) == exactly(2.011715));
  CHECK(*box_shear(0.02, 0.5) == exactly(1.441172));
  CHECK_FALSE(box_shear(0.96, 0.5));
}
