#include "solver/fields/nodal_forces.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

/// A unit square in plane strain.
std::shared_ptr<Mesh> unit_square() {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  return mesh;
}

}  // namespace

TEST_CASE("nodal forces of a square pressed flat are half its stress on each corner", "[fields]") {
  // Plane strain, free sideways: eps_xx = -nu / (1 - nu) eps_yy, sigma_yy = E / (1 - nu^2) eps_yy.
  const double young = 2e9;
  const double nu = 0.3;
  const double strain = -0.02;
  const Body body(unit_square(), Formulation::plane_strain, elastic(young, nu));
  const auto u = body.displacements(
      [&](const Point& x, int c) { return c == 0 ? -nu / (1 - nu) * strain * x[0] : strain * x[1]; });
  const NodalField forces = nodal_forces(*body.assembler, *body.dofs, to_field(u, *body.dofs, "DEPL_R"), {}, 0.0);
  const double expected = 0.5 * young / (1 - nu * nu) * strain;
  for (int node = 0; node < 4; ++node) {
    CHECK(forces.at(node, 0) == Approx(0.0).margin(1e-12 * young));
    CHECK(forces.at(node, 1) == exactly(node < 2 ? -expected : expected));
  }
}

TEST_CASE("reactions are what the applied forces leave of the nodal forces", "[fields]") {
  const Body body(unit_square(), Formulation::plane_strain, elastic(1.0, 0.3));
  const auto u = body.displacements([](const Point& x, int c) { return 0.1 * x[1 - c] * x[c]; });
  const Eigen::VectorXd internal = body.assembler->internal_forces(u);
  auto load = std::make_shared<Load>();
  for (int dof = 4; dof < 8; ++dof)
    load->nodal_forces.push_back({body.dofs->node_of(dof), body.dofs->component_of(dof), internal[dof], {}});
  const FollowerForces none(body.model, *body.dofs, {});
  const NodalField reactions = nodal_reactions(*body.assembler, *body.dofs, to_field(u, *body.dofs, "DEPL_R"),
                                               std::vector<AppliedLoad>{{load, {}}}, none, 0.0);
  CHECK(reactions.at(2, 0) == 0.0);
  CHECK(reactions.at(3, 1) == 0.0);
  CHECK(reactions.at(0, 1) == internal[1]);
}

TEST_CASE("a displacement field that does not belong to the model is refused", "[fields]") {
  const Body body(unit_square(), Formulation::plane_strain, elastic(1.0, 0.3));
  const NodalField field{"DEPL_R", {"DX"}, std::vector<double>(4, 0.0)};
  CHECK_THROWS_WITH(nodal_forces(*body.assembler, *body.dofs, field, {}, 0.0), Catch::Contains("DY"));
}
