#include "solver/functions/function.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

TEST_CASE("a table goes through its points and straight between them", "[functions]") {
  const TabulatedFunction f{.x = {0.0, 1.0, 3.0}, .y = {2.0, 4.0, 0.0}};
  CHECK(f(0.0) == 2.0);
  CHECK(f(1.0) == 4.0);
  CHECK(f(3.0) == 0.0);
  CHECK(f(0.25) == exactly(2.5));
  CHECK(f(2.5) == exactly(1.0));
}

TEST_CASE("past its ends a table follows its rule", "[functions]") {
  TabulatedFunction f{.x = {0.0, 1.0, 3.0}, .y = {2.0, 4.0, 0.0}};
  CHECK_THROWS_WITH(f(-1.0), Catch::Contains("INST = -1") && Catch::Contains("from 0 to 3"));
  CHECK_THROWS_AS(f(3.1), Error);
  CHECK_THROWS_AS(f(std::nan("")), Error);
  CHECK(f(3.0 * (1 + 1e-15)) == 0.0);  // the end, but for rounding
  f.left = Extension::linear;
  f.right = Extension::constant;
  CHECK(f(-1.0) == exactly(0.0));
  CHECK(f(99.0) == 0.0);
}

TEST_CASE("logarithmic scales turn powers into straight lines", "[functions]") {
  TabulatedFunction f{.x = {1.0, 100.0}, .y = {2.0, 2e6}, .x_scale = Scale::logarithmic, .y_scale = Scale::logarithmic};
  CHECK(f(10.0) == exactly(2e3));  // 2 x^3
  f.right = Extension::linear;
  CHECK(f(1000.0) == exactly(2e9));
  f.y[0] = 0.0;
  CHECK_THROWS_WITH(f(10.0), Catch::Contains("not positive"));
}

TEST_CASE("a table of one point is a constant where it is extended so", "[functions]") {
  const TabulatedFunction f{.x = {0.0}, .y = {7.0}, .left = Extension::constant, .right = Extension::constant};
  CHECK(f(-5.0) == 7.0);
  CHECK(f(0.0) == 7.0);
  CHECK(f(5.0) == 7.0);
}
