#include "solver/fields/stresses/traction.hpp"

#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

TEST_CASE("a pressure pulls along the normal, whichever that is") {
  NodalField stresses{"SIEF_R", {"SIXX", "SIYY", "SIZZ", "SIXY"}, {}};
  for (int node = 0; node < 2; ++node) stresses.values.insert(stresses.values.end(), {-3.0, -3.0, -3.0, 0.0});
  const Eigen::Vector3d normal(0.6, 0.0, 0.8);
  const NodalField made = tractions(
      stresses, std::array{1}, [&](int) { return normal; }, "TR_NOR");
  CHECK(made.components == std::vector<std::string>{"TR_NOR_1", "TR_NOR_2", "TR_NOR_3"});
  CHECK(std::isnan(made.at(0, 0)));
  for (int c = 0; c < 3; ++c) CHECK(made.at(1, c) == Approx(-3.0 * normal[c]));
}

TEST_CASE("the part of a vector along a direction is their product") {
  const NodalField vectors{"DEPL_R", {"DX", "DY"}, {1.0, 2.0}};
  const auto along = [](int) { return Eigen::Vector3d(2.0, 1.0, 7.0); };
  CHECK(part_along(vectors, std::array{0}, along, "TRAC_DIR").at(0, 0) == 4.0);
  CHECK_THROWS_AS(tractions(vectors, std::array{0}, along, "TR_DIR"), Error);
}

}  // namespace
}  // namespace comma::solver
