#include "solver/fields/field_history.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

// Two nodes: one swings along X, the other goes along Y and comes back; its DX is not there.
Field swing(double dx, double dy) { return NodalField{"DEPL_R", {"DX", "DY"}, {dx, 0.1, absent, dy}}; }

}  // namespace

TEST_CASE("extremes over time, and when they are reached", "[fields]") {
  const std::array<Field, 3> fields = {swing(2.0, 0.5), swing(-3.0, 4.0), swing(1.0, -1.0)};
  const std::array steps = {FieldAtInstant{1.0, &fields[0]}, FieldAtInstant{2.0, &fields[1]},
                            FieldAtInstant{3.0, &fields[2]}};
  const auto value = [&](ExtremeOverTime which, ExtremeShown shown, int node, int component) {
    return std::get<NodalField>(extreme_over_time(steps, which, shown)).at(node, component);
  };
  CHECK(value(ExtremeOverTime::greatest, ExtremeShown::value, 0, 0) == 2.0);
  CHECK(value(ExtremeOverTime::greatest, ExtremeShown::instant, 0, 0) == 1.0);
  CHECK(value(ExtremeOverTime::least, ExtremeShown::value, 0, 0) == -3.0);
  CHECK(value(ExtremeOverTime::greatest_magnitude, ExtremeShown::value, 0, 0) == -3.0);
  CHECK(value(ExtremeOverTime::greatest_magnitude, ExtremeShown::instant, 0, 0) == 2.0);
  CHECK(value(ExtremeOverTime::least_magnitude, ExtremeShown::value, 1, 1) == 0.5);
  // What stays the same is reached first at the first step.
  CHECK(value(ExtremeOverTime::greatest, ExtremeShown::instant, 0, 1) == 1.0);
  CHECK(std::isnan(value(ExtremeOverTime::greatest, ExtremeShown::value, 1, 0)));
  // All components of the step at which the translation is longest.
  CHECK(value(ExtremeOverTime::longest_translation, ExtremeShown::value, 0, 0) == -3.0);
  CHECK(value(ExtremeOverTime::longest_translation, ExtremeShown::value, 1, 1) == 4.0);
  CHECK(value(ExtremeOverTime::longest_translation, ExtremeShown::instant, 1, 1) == 2.0);
}

TEST_CASE("a field between two instants is linear", "[fields]") {
  const Field first = swing(1.0, 2.0), last = swing(3.0, -2.0);
  const auto middle = std::get<NodalField>(between_instants({1.0, &first}, {5.0, &last}, 2.0));
  CHECK(middle.at(0, 0) == exactly(1.5));
  CHECK(middle.at(1, 1) == exactly(1.0));
  CHECK(std::isnan(middle.at(1, 0)));
}

TEST_CASE("steps with other components have no common extreme", "[fields]") {
  const Field plane = swing(1.0, 2.0), other = NodalField{"DEPL_R", {"DX"}, {1.0, 2.0}};
  const std::array steps = {FieldAtInstant{1.0, &plane}, FieldAtInstant{2.0, &other}};
  CHECK_THROWS_AS(extreme_over_time(steps, ExtremeOverTime::greatest, ExtremeShown::value), Error);
  const Field stress = NodalField{"SIEF_R", {"SIXX"}, {1.0, 2.0}};
  const std::array single = {FieldAtInstant{1.0, &stress}};
  CHECK_THROWS_AS(extreme_over_time(single, ExtremeOverTime::longest_translation, ExtremeShown::value), Error);
}
