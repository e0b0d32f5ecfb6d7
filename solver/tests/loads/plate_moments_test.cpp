#include "solver/loads/plate_moments.hpp"

#include <map>

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

/// A quadrangle and a triangle, neither of them regular.
Mesh two_plates() {
  Mesh mesh;
  mesh.dimension = 3;
  mesh.nodes = {{0, 0, 0}, {2, 0, 0}, {2.5, 1, 0}, {0, 1.5, 0}, {4, 0.5, 0}};
  mesh.add_cell(CellType::quad4, std::vector<int>{0, 1, 2, 3});
  mesh.add_cell(CellType::tria3, std::vector<int>{1, 4, 2});
  return mesh;
}

std::map<Component, double> totals(const std::vector<NodalForce>& forces, const Mesh& mesh, double time) {
  std::map<Component, double> sums;
  for (const NodalForce& force : forces)
    sums[force.component] +=
        force.function ? force.function(mesh.nodes[static_cast<std::size_t>(force.node)], time) : force.value;
  return sums;
}

}  // namespace

TEST_CASE("moments at nodes add up to the moment per area times the area", "[loads]") {
  const Mesh mesh = two_plates();
  const double areas[] = {0.5 * (2 * 1 - 2.5 * 0 + 2.5 * 1.5 - 0 * 1),
                          0.5 * ((4 - 2) * 1 - 0.5 * (2.5 - 2))};  // shoelace
  for (const int cell : {0, 1}) {
    const auto sums = totals(plate_moment_forces(mesh, {cell, {3.0, 0.0, -2.0}, {}}), mesh, 0.0);
    CHECK(sums.at(Component::drx) == exactly(3.0 * areas[cell]));
    CHECK(sums.at(Component::drz) == exactly(-2.0 * areas[cell]));
    CHECK_FALSE(sums.contains(Component::dry));
  }
}

TEST_CASE("a moment that is a function is integrated at each instant", "[loads]") {
  const Mesh mesh = two_plates();
  const PlateMoment growing{
      1, {}, {FieldFunction(), [](const Point& at, double time) { return time * at[0]; }, FieldFunction()}};
  const double area = 0.5 * ((4 - 2) * 1 - 0.5 * (2.5 - 2));
  const double centre = (2.0 + 4.0 + 2.5) / 3.0;
  CHECK(totals(plate_moment_forces(mesh, growing), mesh, 2.0).at(Component::dry) == exactly(2.0 * centre * area));
}
