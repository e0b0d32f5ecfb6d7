// Scenes with an unsymmetric stiffness.
#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/error.hpp"
#include "solver/nonlinear/linear_static_analysis.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace {

constexpr auto dx = Component::dx;
constexpr auto dy = Component::dy;

const Eigen::Matrix2d swerving = (Eigen::Matrix2d() << 10, 4, 0, 5).finished();  // what moves in y is pushed in x

/// A stiff square that stands on two such springs at the lower corners.
struct Square {
  Scene scene;
  Scene::Block block;

  explicit Square(const Eigen::Matrix2d& left, const Eigen::Matrix2d& right)
      : block(scene.block("b", {0, 0}, {1, 1}, 2, 2, 1e9, 0.2)) {
    scene.ground_spring("left", block.nodes[0][0], left);
    scene.ground_spring("right", block.nodes[0][2], right);
  }

  Eigen::Vector2d linear_displacement(int node) {
    Result result;
    Counters counters;
    solve_linear_static(scene.problem, std::vector{1.0}, {}, result, counters);
    const auto& field = std::get<NodalField>(result.steps[0].fields.find("DEPL")->second);
    return {field.at(node, field.component("DX")), field.at(node, field.component("DY"))};
  }
};

std::string message_of(Square& square, const LinearStaticOptions& options = {}) {
  Result result;
  Counters counters;
  try {
    solve_linear_static(square.scene.problem, std::vector{1.0}, options, result, counters);
  } catch (const Error& error) {
    return error.code() + ": " + error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a body on unsymmetric springs is pushed aside", "[unsymmetric]") {
  Square square(swerving, swerving);
  square.scene.force(square.block.nodes[2][1], dy, 30.0);  // halfway between the springs
  const Eigen::Vector2d u = square.linear_displacement(square.block.nodes[0][1]);
  // Both springs together: 10 ux + 4 uy = 0, 5 uy = 15. The sideways forces cancel, so nothing turns.
  CHECK(u[1] == Approx(3.0).epsilon(1e-6));
  CHECK(u[0] == Approx(-1.2).epsilon(1e-6));

  square.scene.solve(1);
  CHECK(square.scene.displacement(square.block.nodes[0][1], dx) == Approx(u[0]).epsilon(1e-12));
  CHECK(square.scene.counters.factorisations == 1);
}

TEST_CASE("imposed displacements ask an unsymmetric spring for forces across them", "[unsymmetric]") {
  Scene scene;
  const int at = scene.node("A", 0, 0);
  scene.ground_spring("s", at, swerving);
  scene.impose({at}, dy, 2.0);
  scene.solve(1);
  CHECK(scene.displacement(at, dx) == exactly(-0.8));
  CHECK(scene.internal_force(at, dy) == exactly(10.0));
}

TEST_CASE("what unsymmetric springs do not hold is named", "[unsymmetric]") {
  // Nothing pushes back in y: a motion that is not rigid alone, since the springs push in x.
  const Eigen::Matrix2d rolling = (Eigen::Matrix2d() << 10, 4, 0, 0).finished();
  Scene scene;
  const int at = scene.node("A", 0, 0);
  scene.ground_spring("s", at, rolling);
  CHECK_THROWS_WITH(scene.solve(1), Catch::Contains("A") && Catch::Contains("singular"));

  SECTION("a body that can turn about the point that holds it") {
    Scene turning;
    const auto block = turning.block("b", {0, 0}, {1, 1}, 2, 2, 1e9, 0.2);
    turning.ground_spring("s", block.nodes[0][0], swerving);
    CHECK_THROWS_WITH(turning.solve(1), Catch::Contains("rotation about Z"));
  }
}

TEST_CASE("conjugate gradients and contact refuse an unsymmetric stiffness", "[unsymmetric]") {
  Square square(swerving, swerving);
  LinearStaticOptions iterations;
  iterations.method = LinearMethod::conjugate_gradient;
  CHECK_THAT(message_of(square, iterations),
             Catch::Contains("unsupported: conjugate gradients need a symmetric stiffness"));
  square.scene.bound({square.block.nodes[2][0]}, dy, 1.0, [](const Point&, double) { return 0.0; });
  CHECK_THROWS_WITH(square.scene.solve(1), Catch::Contains("unilateral conditions need a symmetric stiffness"));
}
