#include "solver/mesh/nearest_name.hpp"

#include <catch2/catch.hpp>
#include <vector>

using comma::solver::nearest_name;

TEST_CASE("the nearest name is the one at the fewest changes, if it is near at all") {
  const std::vector<std::string> known = {"HAUT", "BAS", "GAUCHE"};
  CHECK(nearest_name("HAUTE", known) == "HAUT");
  CHECK(nearest_name("bas", known) == "BAS");
  CHECK(nearest_name("GACHE", known) == "GAUCHE");
  CHECK(nearest_name("XYZXYZ", known).empty());
  CHECK(nearest_name("", known).empty());
  CHECK(nearest_name("HAUT", {}).empty());
}
