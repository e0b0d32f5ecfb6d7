#include "solver/loads/nodal_history.hpp"

#include <catch2/catch.hpp>

#include "solver/error.hpp"

using namespace comma::solver;

TEST_CASE("a history at nodes is linear between its instants and known where all of them are", "[loads]") {
  NodalHistory history;
  CHECK(history.empty());
  history.add(1.0, {"PRES_R", {"PRES"}, {10.0, absent, 30.0}});
  history.add(3.0, {"PRES_R", {"PRES"}, {20.0, 5.0, -30.0}});
  CHECK(history.at(0, 1.0) == 10.0);
  CHECK(history.at(0, 3.0) == 20.0);
  CHECK(history.at(0, 1.5) == Approx(12.5));
  CHECK(history.at(2, 2.0) == Approx(0.0).margin(1e-14));
  CHECK(history.covers(0));
  CHECK_FALSE(history.covers(1));
  CHECK_THROWS_AS(history.at(0, 3.5), Error);
  CHECK_THROWS_AS(history.at(0, 0.5), Error);
}
