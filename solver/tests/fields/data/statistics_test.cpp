#include "solver/fields/data/statistics.hpp"

#include <array>

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;

TEST_CASE("a straight profile has its own ends as ends of the mean line", "[fields]") {
  const std::array<double, 4> at = {1.0, 1.5, 4.0, 5.0};
  std::array<double, 4> values{};
  for (std::size_t i = 0; i < 4; ++i) values[i] = 2.0 - 3.0 * at[i];
  const LineMean mean = line_mean(at, values);
  CHECK(mean.mean == exactly(2.0 - 3.0 * 3.0));
  CHECK(mean.slope == exactly(-12.0));
  CHECK(mean.first() == exactly(values.front()));
  CHECK(mean.last() == exactly(values.back()));
  CHECK(mean.least == values.back());
  CHECK(mean.greatest == values.front());
}

TEST_CASE("a tent has a mean of half its height and no slope", "[fields]") {
  const std::array<double, 3> at = {0.0, 1.0, 2.0};
  const std::array<double, 3> values = {0.0, 6.0, 0.0};
  const LineMean mean = line_mean(at, values);
  CHECK(mean.mean == exactly(3.0));
  CHECK(mean.slope == Approx(0.0).margin(1e-14));
}

TEST_CASE("a line without length has no mean along it", "[fields]") {
  const std::array<double, 1> one = {3.0};
  CHECK_THROWS_WITH(line_mean(one, one), Catch::Contains("two points"));
}

TEST_CASE("extremes say where they are, by value and by magnitude", "[fields]") {
  const Field field = ElementField{"NEUT_R", Support::gauss_point, {"X1"}, {0, 2, 2, 4}, {1.0, -9.0, absent, 4.0}};
  const auto found = extremes(field, 0);
  REQUIRE(found);
  CHECK(found->least.place == 0);
  CHECK(found->least.point == 1);
  CHECK(found->greatest.value == 4.0);
  CHECK(found->greatest.place == 2);
  CHECK(found->greatest_magnitude.value == -9.0);
  CHECK(found->least_magnitude.value == 1.0);
  const std::array<int, 1> empty_cell = {1};
  CHECK_FALSE(extremes(field, 0, std::span<const int>(empty_cell)));
}
