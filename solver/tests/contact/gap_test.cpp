#include "solver/contact/gap.hpp"

#include <random>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"
#include "solver/unilateral/conditions.hpp"

using namespace comma::solver;
using Eigen::Vector3d;

namespace gap_test {

/// A master edge from (2, 0) to (0, 0), normal up, and a slave node above it that a spring carries.
struct Scene {
  std::shared_ptr<Mesh> mesh = std::make_shared<Mesh>();
  Model model;
  ContactDefinition definition;

  Scene() {
    mesh->dimension = 2;
    mesh->nodes = {{2, 0, 0}, {0, 0, 0}, {0.5, 0.25, 0}};
    ContactZone zone;
    zone.master_cells = {mesh->add_cell(CellType::seg2, std::vector<int>{0, 1})};
    zone.slave_cells = {mesh->add_cell(CellType::poi1, std::vector<int>{2})};
    definition.zones = {zone};
    model.mesh = mesh;
    model.formulations = {Formulation::spring_2d, Formulation::spring_2d};
  }

  std::vector<Vector3d> places(const Eigen::VectorXd& u) const {
    std::vector<Vector3d> result;
    for (int i = 0; i < 3; ++i)
      result.emplace_back(mesh->nodes[i][0] + u[2 * i], mesh->nodes[i][1] + u[2 * i + 1], 0.0);
    return result;
  }
};

TEST_CASE("At the geometry of the pairing, bound minus row is the distance") {
  const Scene scene;
  const DofMap dofs(scene.model);
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> move(-0.1, 0.1);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd u = Eigen::VectorXd::NullaryExpr(6, [&] { return move(generator); });
    const auto places = scene.places(u);
    const auto pairs = pair_surfaces(scene.definition, *scene.mesh, places);
    REQUIRE(pairs[0].status == PairingStatus::paired);
    std::vector<int> row_pairs;
    const Inequalities rows = gap_rows(pairs, *scene.mesh, dofs, row_pairs);
    CHECK(row_pairs == std::vector<int>{0});
    const double distance = (places[2] - pairs[0].foot).norm();
    CHECK((rows.bounds - rows.rows * u)[0] == Approx(distance).epsilon(1e-12));
  }
}

TEST_CASE("Moving the slave and the master together leaves the gap alone, and their forces balance") {
  const Scene scene;
  const DofMap dofs(scene.model);
  const auto pairs = pair_surfaces(scene.definition, *scene.mesh, scene.places(Eigen::VectorXd::Zero(6)));
  std::vector<int> row_pairs;
  const Inequalities rows = gap_rows(pairs, *scene.mesh, dofs, row_pairs);
  const Eigen::VectorXd force = -rows.rows.transpose() * Eigen::VectorXd::Constant(1, 8.0);
  CHECK(force[dofs.dof(2, Component::dy)] == exactly(8.0));   // pushes the slave away along the normal
  CHECK(force[dofs.dof(1, Component::dy)] == exactly(-6.0));  // the slave stands a quarter of the way
  CHECK(force[dofs.dof(0, Component::dy)] == exactly(-2.0));
  Eigen::VectorXd translation(6);
  translation << 3, 7, 3, 7, 3, 7;
  CHECK((rows.rows * translation)[0] == Approx(0.0).margin(1e-14));
}

TEST_CASE("A clamped node that touches a clamped facet but for a rounding does not go through it") {
  const Scene scene;
  const DofMap dofs(scene.model);
  Load clamp;
  for (int node = 0; node < 3; ++node)
    for (const Component component : {Component::dx, Component::dy})
      clamp.relations.emplace_back().terms = {{node, component, 1.0}};
  const std::vector<AppliedLoad> loads = {{std::make_shared<const Load>(clamp), nullptr}};
  const Elimination elimination(*scene.mesh, dofs, loads);
  const auto reduced_at = [&](double depth) {
    auto pairs = pair_surfaces(scene.definition, *scene.mesh, scene.places(Eigen::VectorXd::Zero(6)));
    pairs[0].thickness = 0.25 + depth;
    std::vector<int> row_pairs;
    const Inequalities rows = gap_rows(pairs, *scene.mesh, dofs, row_pairs);
    return reduce(rows, elimination, elimination.offset(0.0), [](int) { return std::string("the gap"); });
  };
  CHECK(reduced_at(1e-16).origin.empty());
  CHECK_THROWS_WITH(reduced_at(1e-3), Catch::Contains("imposed displacements violate the gap by 0.001"));
}

TEST_CASE("A slave node without displacements is named") {
  Scene scene;
  scene.model.formulations[1] = Formulation::none;
  const DofMap dofs(scene.model);
  const auto pairs = pair_surfaces(scene.definition, *scene.mesh, scene.places(Eigen::VectorXd::Zero(6)));
  std::vector<int> row_pairs;
  CHECK_THROWS_WITH(gap_rows(pairs, *scene.mesh, dofs, row_pairs), Catch::Contains("N3") && Catch::Contains("DY"));
}

}  // namespace gap_test
