#include "solver/fields/integrals/plane_section.hpp"

#include <array>
#include <cmath>
#include <memory>

#include <catch2/catch.hpp>

namespace comma::solver {
namespace {

// A rectangle of 4 by 2 whose centre lies at (3, 5), turned by an angle.
Model turned_rectangle(double angle) {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  for (const auto& [x, y] : {std::pair{-2.0, -1.0}, {2.0, -1.0}, {2.0, 1.0}, {-2.0, 1.0}})
    mesh->nodes.push_back(
        {3.0 + x * std::cos(angle) - y * std::sin(angle), 5.0 + x * std::sin(angle) + y * std::cos(angle), 0.0});
  mesh->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  return {mesh, {Formulation::plane_strain}};
}

TEST_CASE("a turned rectangle has its moments about axes that are turned alike") {
  constexpr double angle = 0.3;
  const PlaneSection section = plane_section(turned_rectangle(angle), std::array{0});
  CHECK(section.area == Approx(8.0));
  CHECK(section.centre[0] == Approx(3.0));
  CHECK(section.centre[1] == Approx(5.0));
  const PrincipalMoments principal = principal_moments(section.moments);
  CHECK(principal.least == Approx(4.0 * 8.0 / 12.0));
  CHECK(principal.greatest == Approx(2.0 * 64.0 / 12.0));
  CHECK(principal.angle == Approx(angle));
}

TEST_CASE("a section and its image have no product of inertia") {
  const PlaneSection half = plane_section(turned_rectangle(0.3), std::array{0});
  const PlaneSection whole = with_image(half, true);
  CHECK(whole.area == Approx(16.0));
  CHECK(whole.centre[1] == 0.0);
  CHECK(whole.moments.product == 0.0);
  CHECK(whole.moments.first == Approx(2.0 * (half.moments.first + 8.0 * 25.0)));
  CHECK(moments_about(whole, {0.0, 0.0}).second == Approx(2.0 * (half.moments.second + 8.0 * 9.0)));
}

}  // namespace
}  // namespace comma::solver
