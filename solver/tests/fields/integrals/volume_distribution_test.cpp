#include "solver/fields/integrals/volume_distribution.hpp"

#include <catch2/catch.hpp>

#include <array>

#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

TEST_CASE("the volumes of all values are the volume of the body", "[fields]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  mesh->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  const Body body(mesh, Formulation::plane_strain, elastic(1, 0));
  const ElementField field{"NEUT_R", Support::gauss_point, {"X1"}, {0, 4}, {1.0, 2.0, 3.0, 3.0}};
  const std::array cells = {0};
  const auto pieces = value_volumes(body.model, field, 0, cells);
  CHECK(value_range(pieces) == std::pair(1.0, 3.0));
  // A Gauss point stands for a quarter of the area of 2.
  const auto volumes = volumes_between(pieces, std::array{1.0, 2.0, 3.0});
  CHECK(volumes[0] == exactly(1.0));
  CHECK(volumes[1] == exactly(1.0));
  CHECK(volumes_between(pieces, std::array{2.5, 10.0})[0] == exactly(1.0));
}
