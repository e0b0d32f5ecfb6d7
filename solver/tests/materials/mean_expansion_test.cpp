#include <catch2/catch.hpp>

#include "solver/materials/elasticity.hpp"
#include "solver/materials/mean_expansion.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

/// alpha(T) at `temperatures`.
template <class Coefficient>
TabulatedFunction tabulate(const std::vector<double>& temperatures, Coefficient&& coefficient) {
  TabulatedFunction table;
  table.parameter = "TEMP";
  table.x = temperatures;
  for (const double t : temperatures) table.y.push_back(coefficient(t));
  return table;
}

}  // namespace

TEST_CASE(
    "what a coefficient measured elsewhere has of a stretch up to the reference drops out, between its points too",
    "[materials]") {
  // From -100 on, 5e-3 up to 20 and 1e-5 a degree after it: as 1e-5 from 20 on, although the table is a hyperbola.
  const double far = -100.0;
  const TabulatedFunction measured =
      tabulate({0.0, 40.0, 200.0, 1000.0}, [&](double t) { return (5e-3 + 1e-5 * (t - 20.0)) / (t - far); });
  TabulatedFunction exact = measured;
  exact.x.insert(exact.x.begin() + 1, 20.0);
  exact.y.insert(exact.y.begin() + 1, 5e-3 / 120.0);
  const Property from_20 = mean_expansion(exact, far, 1.0);
  MaterialPoint at;
  at.reference(Parameter::temperature) = 20.0;
  for (const double t : {0.0, 20.0, 40.0, 70.0, 200.0, 650.0, 1000.0}) {
    at[Parameter::temperature] = t;
    CHECK(thermal_strain(from_20, at) == Approx(1e-5 * (t - 20.0)).epsilon(1e-12));
  }
}

TEST_CASE("near the reference a mean coefficient is the limit, by the slopes on both sides", "[materials]") {
  const TabulatedFunction measured = tabulate({0.0, 99.5, 120.0}, [](double t) { return 1e-5 + 4e-9 * t; });
  CHECK(expansion_from(100.0, measured, 20.0, 1.0).y[1] == exactly(1e-5 + 4e-7 + 4e-9 * 80.0));
  // No nearness: the quotient itself, which is that of the difference of two strains.
  const double quotient = ((1e-5 + 4e-9 * 99.5) * 79.5 - (1e-5 + 4e-7) * 80.0) / -0.5;
  CHECK(expansion_from(100.0, measured, 20.0, 0.0).y[1] == exactly(quotient));
  CHECK(expansion_from(0.0, measured, 20.0, 1.0).y[0] == exactly(1e-5 - 4e-9 * 20.0));  // one side alone
}

TEST_CASE("mean coefficients follow the reference of the point, and miss a temperature that is not given",
          "[materials]") {
  const TabulatedFunction measured = tabulate({0.0, 100.0, 200.0}, [](double t) { return 1e-5 + 4e-9 * t; });
  const Property expansion = mean_expansion(measured, 20.0, 1.0);
  MaterialPoint at;
  CHECK_THROWS_WITH(expansion(at), Catch::Contains("temperature"));
  at[Parameter::temperature] = 150.0;
  CHECK_THROWS_WITH(expansion(at), Catch::Contains("reference"));
  for (const double reference : {0.0, 60.0, 0.0}) {
    at.reference(Parameter::temperature) = reference;
    CHECK(expansion(at) == expansion_from(reference, measured, 20.0, 1.0)(150.0));
  }
  at.reference(Parameter::temperature) = 300.0;
  CHECK_THROWS_WITH(expansion(at), Catch::Contains("outside"));
}
