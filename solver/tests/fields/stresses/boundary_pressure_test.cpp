#include "solver/fields/stresses/boundary_pressure.hpp"

#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace boundary_pressure_test {

/// The right and the upper edge of a unit square, running round it.
Mesh two_edges() {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_cell(CellType::seg2, std::array{1, 2});
  mesh.add_cell(CellType::seg2, std::array{2, 3});
  return mesh;
}

NodalField uniform(const Mesh& mesh, const std::array<double, 4>& stress) {
  NodalField field{"SIEF_R", {"SIXX", "SIYY", "SIZZ", "SIXY"}, {}};
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    field.values.insert(field.values.end(), stress.begin(), stress.end());
  return field;
}

std::vector<Eigen::Vector3d> places(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> result;
  for (const Point& node : mesh.nodes) result.emplace_back(node[0], node[1], node[2]);
  return result;
}

TEST_CASE("the pressure on a boundary is the stress along its normal", "[fields]") {
  const Mesh mesh = two_edges();
  const NodalField pressure = boundary_pressure(mesh, uniform(mesh, {-3, -5, 0, 2}), std::array{0, 1}, places(mesh));
  CHECK(pressure.at(1, 0) == exactly(-3.0));
  CHECK(pressure.at(3, 0) == exactly(-5.0));
  CHECK(pressure.at(2, 0) == exactly(0.5 * (-3 - 5 + 2 * 2)));  // its normal is (1, 1) / sqrt(2)
  CHECK(std::isnan(pressure.at(0, 0)));
}

TEST_CASE("normals are those of the positions given", "[fields]") {
  const Mesh mesh = two_edges();
  auto moved = places(mesh);
  moved[2] = {2, 1, 0};  // the right edge now leans by 45 degrees
  const NodalField pressure = boundary_pressure(mesh, uniform(mesh, {-3, -5, 0, 2}), std::array{0}, moved);
  CHECK(pressure.at(1, 0) == exactly(0.5 * (-3 - 5 - 2 * 2)));
}

TEST_CASE("a field without stresses has no pressure", "[fields]") {
  const Mesh mesh = two_edges();
  const NodalField displacement{"DEPL_R", {"DX", "DY"}, std::vector<double>(8, 0.0)};
  CHECK_THROWS_AS(boundary_pressure(mesh, displacement, std::array{0}, places(mesh)), Error);
}

TEST_CASE("the traction along a boundary is what the stress has beside the pressure", "[fields]") {
  const Mesh mesh = two_edges();
  const NodalField pressure = boundary_pressure(mesh, uniform(mesh, {-3, -5, 0, 2}), std::array{0, 1}, places(mesh));
  REQUIRE(pressure.components == std::vector<std::string>{"PRES", "CISA", "VX", "VY"});
  // On the right edge S n = (-3, 2), on the upper one (2, -5).
  CHECK(pressure.at(1, 1) == exactly(2.0));
  CHECK(pressure.at(1, 2) == Approx(0.0).margin(1e-15));
  CHECK(pressure.at(1, 3) == exactly(2.0));
  CHECK(pressure.at(3, 2) == exactly(2.0));
  CHECK(pressure.at(3, 3) == Approx(0.0).margin(1e-15));
}

TEST_CASE("in space there is the pressure alone", "[fields]") {
  Mesh mesh = two_edges();
  mesh.dimension = 3;
  const NodalField stress{"SIEF_R", {"SIXX", "SIYY"}, std::vector<double>(8, -3.0)};
  CHECK(boundary_pressure(mesh, stress, std::array<int, 0>{}, places(mesh)).components ==
        std::vector<std::string>{"PRES"});
}

}  // namespace boundary_pressure_test
