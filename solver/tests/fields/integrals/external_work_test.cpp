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

TEST_CASE("work goes on from what a computation before has done", "[fields]") {
  const auto fields = [](double u, double force) {
    ResultStep made = step(0, u, force);
    return std::pair(std::get<NodalField>(made.fields.at("DEPL")), std::get<NodalField>(made.fields.at("FORC_NODA")));
  };
  const auto [u1, f1] = fields(2.0, 6.0);
  const auto [u2, f2] = fields(3.0, 8.0);
  RunningWork from_step(u1, f1, 6.0);
  CHECK(from_step.add(u2, f2).real == exactly(6.0 + 7.0));
  RunningWork from_work(6.0);
  CHECK(from_work.add(u1, f1).real == exactly(6.0));
  CHECK(from_work.add(u2, f2).real == exactly(6.0 + 7.0));
}
