#include "solver/contact_law/contact_rows.hpp"

#include <catch2/catch.hpp>

#include "solver/model/deformed_places.hpp"
#include "solver/tests/nonlinear/scene.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace {

/// A square above another one, 0.1 apart, with friction; the lower one is held.
struct TwoSquares {
  Scene scene;
  Scene::Block lower = scene.block("l", {0, 0}, {1, 1}, 1, 1, 1.0, 0.0);
  Scene::Block upper = scene.block("u", {0, 1.1}, {1, 1}, 2, 1, 1.0, 0.0);
  std::unique_ptr<DofMap> dofs;
  std::unique_ptr<Elimination> elimination;
  std::unique_ptr<ContactRows> rows;

  TwoSquares() {
    scene.zone(lower.top, upper.bottom).mixed.friction = 0.3;
    scene.problem.contact->formulation = ContactFormulation::mixed;
    for (const auto& row : lower.nodes)
      for (const Component component : {Component::dx, Component::dy}) scene.impose(row, component, 0.0);
    dofs = std::make_unique<DofMap>(*scene.problem.model);
    elimination = std::make_unique<Elimination>(*scene.mesh, *dofs, scene.problem.loads);
    rows = std::make_unique<ContactRows>(*scene.problem.contact, *scene.problem.model, *dofs, *elimination);
  }

  /// The upper square moves as a whole.
  Eigen::VectorXd moved(double x, double y) const {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(dofs->size());
    for (const auto& row : upper.nodes)
      for (const int node : row) {
        u[dofs->dof(node, Component::dx)] = x;
        u[dofs->dof(node, Component::dy)] = y;
      }
    return u;
  }
};

}  // namespace

TEST_CASE("Contact rows give the gap and the slip since the step began") {
  TwoSquares scene;
  const Eigen::VectorXd before = scene.moved(0.02, -0.05);
  scene.rows->face(positions_at(before, *scene.scene.mesh, *scene.dofs), 0.0, 0.0);
  auto points = scene.rows->build(before);
  REQUIRE(points.size() == 3);
  REQUIRE(scene.rows->dimension() == 2);
  const auto slip_sign = [&](std::size_t p) { return scene.rows->directions(scene.rows->points()[p])[1][0]; };
  const Eigen::VectorXd jumps = scene.rows->jumps(scene.moved(0.05, -0.1));
  for (std::size_t p = 0; p < points.size(); ++p) {
    REQUIRE(points[p].rows == 2);
    CHECK(std::abs(jumps[points[p].first_row]) < 1e-15);
    CHECK(jumps[points[p].first_row + 1] == Approx(0.03 * slip_sign(p)).epsilon(1e-12));
  }
  scene.rows->count_slips(points, scene.moved(0.05, 0.0));
  CHECK(std::abs(scene.rows->jumps(scene.moved(0.05, -0.1))[points[0].first_row + 1]) < 1e-15);
}

TEST_CASE("Contact rows on the unknowns that conditions leave move nothing of a body that is held") {
  TwoSquares scene;
  scene.rows->face(positions_at(scene.moved(0, 0), *scene.scene.mesh, *scene.dofs), 0.0, 0.0);
  scene.rows->build(scene.moved(0, 0));
  CHECK(scene.rows->reduced().cols() == 2 * 6);
  CHECK(scene.rows->blocked().empty());
  // A motion of the upper square is all that the gap sees.
  const Eigen::VectorXd up = Eigen::VectorXd::Ones(scene.rows->reduced().cols());
  CHECK((scene.rows->reduced() * up).cwiseAbs().minCoeff() == Approx(1.0).epsilon(1e-12));
}
