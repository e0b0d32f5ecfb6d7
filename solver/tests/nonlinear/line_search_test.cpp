#include <catch2/catch.hpp>

#include <cmath>

#include "solver/error.hpp"
#include "solver/nonlinear/line_search.hpp"

using namespace comma::solver;

TEST_CASE("the line search leaves a full step that is good enough, and finds where work vanishes") {
  LineSearch options;
  int calls = 0;
  CHECK(search_line(options, 1.0, [&](double rho) { ++calls; return 1.0 - rho + 0.05; }) == 1.0);
  CHECK(calls == 1);
  options.tolerance = 1e-8;
  options.max_iterations = 50;
  for (const bool bracketed : {false, true}) {
    options.bracketed = bracketed;
    const double rho = search_line(options, 1.0, [](double at) { return std::cos(3.0 * at); });
    CHECK(rho == Approx(M_PI / 6).epsilon(1e-6));
  }
}

TEST_CASE("the line search keeps to its bounds and comes back from where the law cannot follow") {
  LineSearch options;
  options.largest = 2.0;
  CHECK(search_line(options, 1.0, [](double rho) { return 1.0 - 0.1 * rho; }) == 2.0);
  const double rho = search_line(options, 1.0, [](double at) -> double {
    if (at > 0.6) throw Error("integration-failure", "too far");
    return 1.0 - 2.0 * at;
  });
  CHECK(rho == Approx(0.5));
  CHECK_THROWS_WITH(search_line(options, 1.0, [](double) -> double { throw Error("integration-failure", "nowhere"); }), "nowhere");
}
