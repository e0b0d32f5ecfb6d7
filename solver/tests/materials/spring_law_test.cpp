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
        const SpringPast past{start, 0.5 * start, 0.0};
        const SpringResponse response = hardening_response(law, stiffness, displacement, past);
        CHECK(response.force == exactly(stiffness * (displacement - response.reached.plastic)));
        const double apart = response.force - centre(law, response.reached.flowed);
        CHECK(std::abs(apart) <= law.yield * (1.0 + 1e-12));
        if (response.reached.flowed == past.flowed) continue;
        CHECK(std::abs(apart) == Approx(law.yield).epsilon(1e-12));
        CHECK((response.reached.flowed - past.flowed) * apart > 0.0);
        constexpr double h = 1e-6;
        const double slope = (hardening_response(law, stiffness, displacement + h, past).force -
                              hardening_response(law, stiffness, displacement - h, past).force) /
                             (2.0 * h);
        CHECK(response.tangent == Approx(slope).epsilon(1e-6).margin(1e-7));
      }
    }
  }
}

TEST_CASE("a spring that hardens is pulled as in Code_Aster 17.3, and back, in one step or several") {
  const HardeningSpring law{20.0, 50.0, 2.0, 25.0};
  constexpr double stiffness = 500.0;
  SpringPast past;
  for (const double displacement : {0.025, 0.05, 0.075, 0.1})
    past = hardening_response(law, stiffness, displacement, past).reached;
  CHECK(past.plastic == Approx(0.054042739).epsilon(1e-8));
  CHECK(past.flowed == Approx(0.06).epsilon(1e-13));
  CHECK(past.spent == Approx(1.16160688).epsilon(1e-8));
  CHECK(hardening_response(law, stiffness, 0.1, {}).force == Approx(22.9786305).epsilon(1e-8));
  CHECK(hardening_response(law, stiffness, 0.01, past).force == Approx(-17.512407).epsilon(1e-8));
  CHECK(flowed_for_centre(law, centre(law, 0.06)) == Approx(0.06).epsilon(1e-12));
}

}  // namespace spring_law_test
