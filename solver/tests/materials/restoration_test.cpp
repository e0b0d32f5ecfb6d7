#include "solver/materials/behaviour/restoration.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "solver/error.hpp"

using namespace comma::solver;

namespace {

const HardeningRestoration annealing{0.7, 0.2, 100.0, 200.0};

MaterialPoint at_temperature(double temperature) {
  MaterialPoint point;
  point[Parameter::temperature] = temperature;
  return point;
}

double after(double temperature, double time, int steps) {
  Hardened hardened{0.01, 0.01};
  for (int step = 0; step < steps; ++step)
    hardened = restored(annealing, at_temperature(temperature), time / steps, hardened);
  CHECK(hardened.before == 0.01);
  return hardened.strain;
}

}  // namespace

TEST_CASE("hardening is restored at its speed, to the first power of the step", "[materials]") {
  const double rate = std::expm1(0.7 * 25.0 / 75.0);
  const double exact = 0.002 + 0.008 * std::exp(-2.0 * rate);
  const double coarse = after(125.0, 2.0, 100) - exact, fine = after(125.0, 2.0, 200) - exact;
  CHECK(coarse / fine == Approx(2.0).epsilon(0.02));
  CHECK(after(125.0, 2.0, 1) == Approx(0.002 + 0.008 / (1.0 + 2.0 * rate)).epsilon(1e-14));
}

TEST_CASE("hardening is restored between two temperatures alone", "[materials]") {
  for (const double outside : {20.0, 100.0, 100.0 + 1e-12, 200.0 - 1e-12, 200.0, 300.0}) {
    CAPTURE(outside);
    const Hardened hardened = restored(annealing, at_temperature(outside), 1.0, {0.004, 0.01});
    CHECK(hardened.strain == 0.004);
    CHECK(hardened.before == 0.004);
  }
  CHECK(after(199.9, 1.0, 1) == Approx(0.002).epsilon(1e-14));
}

TEST_CASE("hardening below what is left in the end stays", "[materials]") {
  const Hardened hardened = restored(annealing, at_temperature(150.0), 1.0, {0.001, 0.01});
  CHECK(hardened.strain == 0.001);
  CHECK(hardened.before == 0.01);
}

TEST_CASE("hardening is restored by a temperature, and grows by no material", "[materials]") {
  CHECK_THROWS_WITH(restored(annealing, MaterialPoint(), 1.0, {}), Catch::Contains("temperature"));
  const HardeningRestoration growing{-0.7, 0.2, 100.0, 200.0};
  CHECK_THROWS_WITH(restored(growing, at_temperature(150.0), 1.0, {}), Catch::Contains("COEF_ECRO is -0.7"));
  const HardeningRestoration negative{0.7, -0.2, 100.0, 200.0};
  CHECK_THROWS_WITH(restored(negative, at_temperature(150.0), 1.0, {}), Catch::Contains("TAU_INF is -0.2"));
}
