#include "solver/materials/spring_law.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace spring_law_test {

/// The centre of the elastic domain, as R5.03.17 has it.
double centre(const HardeningSpring& law, double plastic) {
  const double straight = law.slope * plastic;
  return law.power == 0.0
             ? straight
             : straight / std::pow(1.0 + std::pow(std::abs(straight) / law.limit, law.power), 1.0 / law.power);
}

TEST_CASE("a bilinear spring bends at its bound and is odd") {
  CHECK(bilinear_response(2.0, 0.5, 4.0, 1.5).force == 3.0);
  const SpringResponse beyond = bilinear_response(2.0, 0.5, 4.0, -6.0);
  CHECK(beyond.force == -6.0);
  CHECK(beyond.tangent == 0.5);
}

TEST_CASE("a spring that hardens lies on its yield surface, with the derivative of its force as tangent") {
  constexpr double stiffness = 20.0;
  for (const HardeningSpring& law : {HardeningSpring{3.0, 1.5, 0.0, 0.0}, HardeningSpring{3.0, 1.5, 2.0, 4.0},
                                     HardeningSpring{3.0, 50.0, 7.0, 0.3}, HardeningSpring{3.0, 0.0, 0.0, 0.0}}) {
    for (const double start : {0.0, 0.4, -1.0}) {
      for (const double displacement : {-30.0, -1.0, 0.1, 0.7, 4.0}) {
        const SpringResponse response = hardening_response(law, stiffness, displacement, start);
        CHECK(response.force == exactly(stiffness * (displacement - response.plastic)));
        const double apart = response.force - centre(law, response.plastic);
        CHECK(std::abs(apart) <= law.yield * (1.0 + 1e-12));
        if (response.plastic == start) continue;
        CHECK(std::abs(apart) == Approx(law.yield).epsilon(1e-12));
        CHECK((response.plastic - start) * apart > 0.0);
        constexpr double h = 1e-6;
        const double slope = (hardening_response(law, stiffness, displacement + h, start).force -
                              hardening_response(law, stiffness, displacement - h, start).force) /
                             (2.0 * h);
        CHECK(response.tangent == Approx(slope).epsilon(1e-6).margin(1e-7));
      }
    }
  }
}

TEST_CASE("a spring that hardens up to a limit is pulled along the curve of the manual") {
  const HardeningSpring law{3.0, 1.0, 2.0, 4.0};
  // X = 3 of the force 6: a = 3 / sqrt(1 - 9 / 16).
  const double plastic = 3.0 / std::sqrt(1.0 - 9.0 / 16.0);
  CHECK(hardening_response(law, 2.0, 3.0 + plastic, 0.0).force == Approx(6.0).epsilon(1e-13));
}

}  // namespace spring_law_test
