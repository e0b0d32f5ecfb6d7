#include "solver/functions/time_bracket.hpp"

#include <array>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

constexpr std::array<double, 3> instants = {1.0, 2.0, 4.0};

double square_between(double time, Extension left, Extension right) {
  const auto [first, share] = time_bracket(instants, time, left, right, "it");
  const double before = instants[first] * instants[first];
  return share == 0.0 ? before : (1.0 - share) * before + share * instants[first + 1] * instants[first + 1];
}

}  // namespace

TEST_CASE("between two instants a value is linear, at each it is exact") {
  for (const double time : instants)
    CHECK(square_between(time, Extension::excluded, Extension::excluded) == time * time);
  CHECK(square_between(3.0, Extension::excluded, Extension::excluded) == exactly(10.0));
  CHECK(square_between(1.25, Extension::excluded, Extension::excluded) == exactly(1.75));
}

TEST_CASE("outside the instants a value is excluded, constant, or goes on in a straight line") {
  CHECK_THROWS_AS(square_between(0.5, Extension::excluded, Extension::linear), Error);
  CHECK_THROWS_AS(square_between(4.5, Extension::linear, Extension::excluded), Error);
  CHECK(square_between(0.0, Extension::constant, Extension::excluded) == 1.0);
  CHECK(square_between(9.0, Extension::excluded, Extension::constant) == 16.0);
  CHECK(square_between(0.0, Extension::linear, Extension::excluded) == exactly(-2.0));
  CHECK(square_between(5.0, Extension::excluded, Extension::linear) == exactly(22.0));
}

TEST_CASE("an instant that is a sum of steps meets the last one although it misses it by rounding") {
  double time = 0.0;
  for (int k = 0; k < 40; ++k) time += 0.1;
  REQUIRE(time != 4.0);
  CHECK(square_between(time, Extension::excluded, Extension::excluded) == 16.0);
}

TEST_CASE("a single instant is continued as a constant, where that is not excluded") {
  constexpr std::array<double, 1> one = {3.0};
  for (const Extension extension : {Extension::constant, Extension::linear}) {
    for (const double time : {-1.0, 3.0, 8.0}) {
      const TimeBracket bracket = time_bracket(one, time, extension, extension, "it");
      CHECK(bracket.first == 0);
      CHECK(bracket.share == 0.0);
    }
  }
  CHECK_NOTHROW(time_bracket(one, 3.0, Extension::excluded, Extension::excluded, "it"));
  CHECK_THROWS_WITH(time_bracket(one, 3.1, Extension::constant, Extension::excluded, "it"),
                    Catch::Contains("it is given at 3 alone"));
}
