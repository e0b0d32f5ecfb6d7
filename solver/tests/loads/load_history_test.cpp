#include "solver/loads/load_history.hpp"

#include <array>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

TEST_CASE("a history at nodes is linear between its instants and known where all of them are", "[loads]") {
  LoadHistory history;
  CHECK(history.empty());
  history.add(1.0, NodalField{"PRES_R", {"PRES"}, {10.0, absent, 30.0}}, 0);
  history.add(3.0, NodalField{"PRES_R", {"PRES"}, {20.0, 5.0, -30.0}}, 0);
  CHECK(history.at(0, 1.0) == 10.0);
  CHECK(history.at(0, 3.0) == 20.0);
  CHECK(history.at(0, 1.5) == exactly(12.5));
  CHECK(history.at(2, 2.0) == Approx(0.0).margin(1e-14));
  CHECK(history.coverage(0) == Coverage::whole);
  CHECK(history.coverage(1) == Coverage::partial);
  CHECK_THROWS_AS(history.at(0, 3.5), Error);
  CHECK_THROWS_AS(history.at(0, 0.5), Error);
}

TEST_CASE("a history on cells has one value a cell or one at each of its nodes", "[loads]") {
  const std::array nodes = {4, 7};
  LoadHistory whole, ends;
  whole.add(0.0, ElementField{"FORC_R", Support::cell, {"FX", "FY"}, {0, 0, 1}, {1.0, 3.0}}, 1);
  ends.add(0.0, ElementField{"PRES_R", Support::element_node, {"PRES"}, {0, 1, 3}, {9.0, 2.0, 5.0}}, 0);
  CHECK(whole.coverage(1, nodes) == Coverage::whole);
  CHECK(whole.coverage(0, nodes) == Coverage::none);
  CHECK(ends.coverage(0, nodes) == Coverage::none);
  CHECK(whole.coverage(4) == Coverage::none);
  for (const int local : {0, 1}) CHECK(whole.at(1, local, nodes[static_cast<std::size_t>(local)], 5.0) == 3.0);
  CHECK(ends.at(1, 0, 4, 5.0) == 2.0);
  CHECK(ends.at(1, 1, 7, 5.0) == 5.0);
}
