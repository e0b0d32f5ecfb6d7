#include "solver/fields/integrals/external_work.hpp"

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

ResultStep step(int order, double u, double force) {
  ResultStep result;
  result.order = order;
  result.instant = order;
  result.fields.emplace("DEPL", NodalField{"DEPL_R", {"DX", "LAGS_C"}, {u, 5.0, 0.0, absent}});
  result.fields.emplace("FORC_NODA", NodalField{"DEPL_R", {"DX"}, {force, -force}});
  return result;
}

}  // namespace

TEST_CASE("the work of a force is the area under its curve", "[fields]") {
  Result result;
  result.steps = {step(0, 0.0, 0.0), step(1, 2.0, 6.0), step(2, 3.0, 6.0)};
  const auto works = external_work(result);
  REQUIRE(works.size() == 3);
  CHECK(works[0].real == 0.0);
  CHECK(works[1].real == exactly(6.0));
  CHECK(works[2].real == exactly(6.0 + 6.0));  // at a force that stays
  CHECK(works[2].elastic == exactly(9.0));     // had it grown in proportion
}

TEST_CASE("work counts from the first step of a result, which may be loaded", "[fields]") {
  Result result;
  result.steps = {step(1, 2.0, 6.0), step(2, 3.0, 9.0)};
  const auto works = external_work(result);
  CHECK(works[0].real == 0.0);
  CHECK(works[0].elastic == exactly(6.0));
  CHECK(works[1].real == exactly(7.5));
}

TEST_CASE("without nodal forces there is no work to tell", "[fields]") {
  Result result;
  result.steps = {step(1, 2.0, 6.0)};
  result.steps[0].fields.erase("FORC_NODA");
  CHECK_THROWS_AS(external_work(result), Error);
}
