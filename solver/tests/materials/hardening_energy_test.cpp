#include "solver/materials/behaviour/hardening_energy.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

constexpr NonlinearHardening saturating = {200.0, 1.5e3, 60.0, 80.0, 25.0, 400.0, 40.0, 1e-3, 0.2, 0.0};

NonlinearHardening with_plateau(NonlinearHardening law, double end) {
  law.plateau = end;
  return law;
}

/// Simpson's rule in so many pieces that its error is beneath that of the difference.
double by_quadrature(const HardeningCurve& curve, double p) {
  constexpr int pieces = 20000;
  const double h = p / pieces;
  double sum = 0.0;
  for (int k = 0; k < pieces; ++k)
    sum += h / 6.0 *
           (hardening(curve, k * h).first + 4.0 * hardening(curve, (k + 0.5) * h).first +
            hardening(curve, (k + 1) * h).first);
  return sum;
}

}  // namespace

TEST_CASE("the energy of the flow is the area under R(p)") {
  const PiecewiseCurve pieces{{{0.0, 100.0}, {0.01, 150.0}, {0.03, 160.0}}, 200.0, false};
  for (const double p : {0.004, 0.02, 0.05}) {
    CHECK(hardening_energy(pieces, p) == Approx(by_quadrature(pieces, p)).epsilon(1e-6));
    CHECK(hardening_energy(PowerCurve{120.0, 300.0, 0.3}, p) ==
          Approx(by_quadrature(PowerCurve{120.0, 300.0, 0.3}, p)).epsilon(1e-5));
    CHECK(hardening_energy(saturating, p) == Approx(by_quadrature(saturating, p)).epsilon(1e-8));
    CHECK(hardening_energy(with_plateau(saturating, 0.0151), p) ==
          Approx(by_quadrature(with_plateau(saturating, 0.0151), p)).epsilon(1e-6));
  }
  CHECK(hardening_energy(saturating, 0.0) == 0.0);
  CHECK(hardening_energy(NoYield{}, 0.1) == 0.0);
}

TEST_CASE("along Lueders' plateau the yield stress is that at its end, and from there on the law is the same") {
  constexpr double end = 0.02;
  const NonlinearHardening law = with_plateau(saturating, end);
  for (const double p : {0.0, 0.3 * end, 0.999 * end}) {
    CHECK(hardening(law, p).first == hardening(saturating, end).first);
    CHECK(hardening(law, p).second == 0.0);
  }
  for (const double p : {end, 1.5 * end}) CHECK(hardening(law, p) == hardening(saturating, p));
}

TEST_CASE("below zero, where rounding or interpolation may leave a plastic strain, the first piece of R(p) goes on") {
  const PiecewiseCurve line{{{0.0, 100.0}}, 50.0, true};
  CHECK(hardening(line, -1e-16) == std::pair(100.0 - 50.0 * 1e-16, 50.0));
  CHECK(hardening(line, -0.5) == std::pair(75.0, 50.0));
  CHECK(hardening(PiecewiseCurve{{{0.0, 100.0}, {1.0, 120.0}}, 0.0, false}, -0.5) == std::pair(90.0, 20.0));
}
