#include "commands/text_listing.hpp"

#include <array>
#include <catch2/catch.hpp>

using namespace comma::commands;
namespace solver = comma::solver;

namespace text_listing_test {

TEST_CASE("Extremes of a listing are those of the values within its bounds") {
  solver::Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const solver::Field field = solver::NodalField{"DEPL_R", {"DX"}, {-5.0, 1.0, 7.0}};
  ListingStyle style{.reals = RealFormat("1PE12.5")};
  style.least = -1.0;
  style.greatest = 4.0;
  const std::string text = extreme_listing(field, mesh, style, std::array{Extremum::greatest, Extremum::least});
  CHECK(text.find(mesh.node_name(1)) != std::string::npos);
  CHECK(text.find(mesh.node_name(0)) == std::string::npos);
  CHECK(text.find(mesh.node_name(2)) == std::string::npos);
}

}  // namespace text_listing_test
