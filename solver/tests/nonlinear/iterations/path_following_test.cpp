#include "solver/nonlinear/iterations/path_following.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"
#include "solver/tests/nonlinear/scene.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace {

double intensity(const Scene& scene, std::size_t step) {
  return scene.result.steps[step].parameters.at("ETA_PILOTAGE");
}

/// Two springs of 100 and 50 along x and y from a node to the ground. A force of (3, 4) on it is driven, one of (6, 0)
/// stands still.
struct Springs {
  Scene scene;
  int node;
  NewtonOptions options;

  Springs() : node(scene.node("P", 0, 0)) {
    scene.ground_spring("k", node, 100.0, 50.0);
    scene.force(node, Component::dx, 6.0);
    auto driven = std::make_shared<Load>();
    driven->nodal_forces.push_back({.node = node, .component = Component::dx, .value = 3.0, .function = {}});
    driven->nodal_forces.push_back({.node = node, .component = Component::dy, .value = 4.0, .function = {}});
    scene.problem.driven.push_back({driven, {}});
    options.path.emplace();
    options.path->nodes = {node};
    options.path->components = {Component::dy};
  }
};

/// A bar of metal, pulled by a driven stress of 1; nu = 0 and the sides are free, so that it is pulled as a bar until
/// it flows.
struct Metal {
  static constexpr double young = 1000.0;
  static constexpr double yield = 5.0;
  Scene scene;
  Scene::Block block;
  NewtonOptions options;

  explicit Metal(double slope) : block(scene.block("b", {0, 0}, {1, 1}, 1, 1, young, 0.0)) {
    auto materials = std::make_shared<MaterialField>(*scene.problem.materials);
    for (auto& material : materials->by_cell) {
      if (!material) continue;
      Material metal = *material;
      metal.plasticity.linear = LinearHardening{slope, yield};
      material = std::make_shared<const Material>(metal);
    }
    scene.problem.materials = materials;
    scene.problem.behaviours =
        std::make_shared<const BehaviourOfCells>(static_cast<std::size_t>(scene.mesh->cell_count()),
                                                 CellBehaviour{Kinematics::small, Relation::isotropic_linear});
    scene.impose(block.nodes.front(), Component::dy, 0.0);
    scene.impose({block.nodes[0][0]}, Component::dx, 0.0);
    auto driven = std::make_shared<Load>();
    for (const int node : block.nodes.back())
      driven->nodal_forces.push_back({.node = node, .component = Component::dy, .value = 0.5, .function = {}});
    scene.problem.driven.push_back({driven, {}});
    options.path.emplace();
    options.relative_residual = 1e-8;
  }
};

}  // namespace

TEST_CASE("Path following: the intensity that moves one displacement by the length of the step") {
  Springs springs;
  springs.options.path->scale = 10.0;  // a step of 1 s moves DY by 0.1
  springs.scene.solve(3, springs.options);
  for (const std::size_t step : {1u, 2u, 3u}) {
    const double x = 0.1 * static_cast<double>(step) * 50.0 / 4.0;
    CHECK(intensity(springs.scene, step) == Approx(x).epsilon(1e-12));
    CHECK(springs.scene.displacement(springs.node, Component::dx, static_cast<int>(step)) ==
          Approx((6.0 + 3.0 * x) / 100.0).epsilon(1e-12));
  }
  CHECK(springs.scene.counters.factorisations == 1);
}

TEST_CASE("Path following by arc length: the increment of a node has the length of the step, and goes on as it went") {
  Springs springs;
  springs.options.path->measure = PathMeasure::arc_length;
  springs.options.path->components = {Component::dx, Component::dy};
  springs.options.path->choice = PathChoice::smallest_angle;
  springs.options.path->scale = 5.0;
  springs.scene.solve(4, springs.options);
  for (const int step : {1, 2, 3, 4}) {
    const double dx = springs.scene.displacement(springs.node, Component::dx, step) -
                      springs.scene.displacement(springs.node, Component::dx, step - 1);
    const double dy = springs.scene.displacement(springs.node, Component::dy, step) -
                      springs.scene.displacement(springs.node, Component::dy, step - 1);
    CHECK(std::hypot(dx, dy) == Approx(0.2).epsilon(1e-12));
    CHECK(intensity(springs.scene, static_cast<std::size_t>(step)) >
          intensity(springs.scene, static_cast<std::size_t>(step) - 1));
  }
}

TEST_CASE("Path following ends with the step that reaches a bound") {
  Springs springs;
  springs.options.path->scale = 10.0;
  springs.options.path->most = 3.0;  // 1.25 a step
  springs.scene.solve(10, springs.options);
  REQUIRE(springs.scene.result.steps.size() == 4);
  CHECK(intensity(springs.scene, 3) == 3.0);
  CHECK(springs.scene.displacement(springs.node, Component::dy) == Approx(3.0 * 4.0 / 50.0).epsilon(1e-12));
  Springs beyond;
  beyond.options.path = springs.options.path;
  beyond.options.path->stops_at_bound = false;
  beyond.scene.solve(10, beyond.options);
  REQUIRE(beyond.scene.result.steps.size() == 4);
  CHECK(intensity(beyond.scene, 3) == exactly(3.75));
}

TEST_CASE("Path following: an intensity that may not fall, and a displacement that loads do not move") {
  Springs springs;
  springs.options.path->grows = true;
  springs.options.path->scale = -10.0;
  CHECK_THROWS_WITH(springs.scene.solve(1, springs.options), Catch::Contains("no admitted intensity"));
  Springs held;
  held.scene.impose({held.node}, Component::dy, 0.0);
  CHECK_THROWS_WITH(held.scene.solve(1, held.options), Catch::Contains("no intensity of the driven loads"));
}

TEST_CASE("Path following drives imposed displacements too") {
  Scene scene;
  const int node = scene.node("P", 0, 0), other = scene.node("Q", 1, 0);
  scene.spring("k", node, other, 30.0, 1.0);
  scene.ground_spring("g", other, 10.0, 1.0);
  auto driven = std::make_shared<Load>();
  LinearRelation relation;
  relation.terms = {{node, Component::dx, 1.0}};
  relation.value = 2.0;
  relation.origin = std::make_shared<const std::string>("driven in the scene");
  driven->relations.push_back(relation);
  scene.impose({node}, Component::dy, 0.0);
  scene.problem.driven.push_back({driven, {}});
  NewtonOptions options;
  options.path.emplace();
  options.path->nodes = {other};
  options.path->components = {Component::dx};
  scene.solve(1, options);
  // The free end follows by 30 / 40 of the imposed 2 x.
  CHECK(intensity(scene, 1) == Approx(1.0 / 1.5).epsilon(1e-12));
  CHECK(scene.displacement(node, Component::dx) == Approx(2.0 / 1.5).epsilon(1e-12));
}

TEST_CASE("Path following by the elastic prediction: to the yield surface and beyond it") {
  Metal metal(100.0);
  metal.options.path->measure = PathMeasure::elastic_prediction;
  metal.options.path->choice = PathChoice::smallest_residual;
  metal.options.path->least_sought = 0.0;
  metal.options.path->scale = 1e9;
  metal.scene.solve(1, metal.options);
  CHECK(intensity(metal.scene, 1) == Approx(Metal::yield).epsilon(1e-7));
  // Compression reaches it as well: the other solution.
  Metal other(100.0);
  other.options.path = metal.options.path;
  other.options.path->least_sought = -100.0;
  other.options.path->most_sought = 0.0;
  other.scene.solve(1, other.options);
  CHECK(intensity(other.scene, 1) == Approx(-Metal::yield).epsilon(1e-7));
}

TEST_CASE("Path following goes on where the load hardly does: plastic flow of a bar in plane strain") {
  Metal metal(0.1);
  metal.options.path->nodes = {metal.block.nodes[1][1]};
  metal.options.path->components = {Component::dy};
  metal.options.path->scale = 250.0;  // 0.004 a step: yield at 0.005
  metal.options.relative_residual = 1e-6;
  metal.scene.solve(20, metal.options);
  CHECK(intensity(metal.scene, 1) == Approx(4.0).epsilon(1e-10));
  CHECK(metal.scene.displacement(metal.block.nodes[1][1], Component::dy) == Approx(0.08).epsilon(1e-9));
  // Flow without a change of volume: the stress along z tends to half of that along y, which is 2 / sqrt(3) of the
  // yield stress then.
  const auto& variables = std::get<ElementField>(metal.scene.result.steps.back().fields.at("VARI_ELGA"));
  const double now =
      Metal::yield + Metal::young * 0.1 / (Metal::young - 0.1) * variables.at(0, 0, variables.component("V1"));
  CHECK(intensity(metal.scene, 20) == Approx(2.0 / std::sqrt(3.0) * now).epsilon(1e-4));
}

TEST_CASE("Path following from rest into plastic flow: the smaller increment of two, and no way back by rounding") {
  Metal metal(100.0);
  metal.options.path->measure = PathMeasure::elastic_prediction;
  metal.options.path->scale = 20.0;  // the prediction of each step goes 1/20 beyond the yield surface
  metal.scene.solve(3, metal.options);
  const auto& variables = std::get<ElementField>(metal.scene.result.steps.back().fields.at("VARI_ELGA"));
  CHECK(intensity(metal.scene, 1) > Metal::yield);
  CHECK(intensity(metal.scene, 3) > intensity(metal.scene, 1));
  CHECK(variables.at(0, 0, variables.component("V1")) > 0.0);

  Metal along(100.0);
  const int node = along.block.nodes[1][1];
  along.options.path->measure = PathMeasure::arc_length;
  along.options.path->nodes = {node};
  along.options.path->components = {Component::dx, Component::dy};
  along.options.path->scale = 250.0;  // 0.004 a step: yield at 0.005
  along.scene.solve(20, along.options);
  for (std::size_t step = 1; step <= 20; ++step) {
    const int now = static_cast<int>(step);
    const double dx =
        along.scene.displacement(node, Component::dx, now) - along.scene.displacement(node, Component::dx, now - 1);
    const double dy =
        along.scene.displacement(node, Component::dy, now) - along.scene.displacement(node, Component::dy, now - 1);
    CHECK(std::hypot(dx, dy) == Approx(0.004).epsilon(1e-9));
    CHECK(intensity(along.scene, step) > intensity(along.scene, step - 1));
  }
}

TEST_CASE("Path following: supports whose reactions are not those of the body yet are out of balance") {
  // All of a block that flows is held or driven: nothing is left free to be out of balance.
  Metal metal(100.0);
  auto driven = std::make_shared<Load>();
  for (const int node : metal.block.nodes.back()) {
    LinearRelation relation;
    relation.terms = {{node, Component::dy, 1.0}};
    relation.value = 1.0;
    relation.origin = std::make_shared<const std::string>("driven in the scene");
    driven->relations.push_back(relation);
  }
  metal.scene.problem.driven = {{driven, {}}};
  for (const auto& row : metal.block.nodes) metal.scene.impose(row, Component::dx, 0.0);
  metal.options.path->nodes = {metal.block.nodes.back().front()};
  metal.options.path->components = {Component::dy};
  metal.options.path->scale = 50.0;  // a step of 1 s strains by four times the yield strain
  metal.scene.solve(1, metal.options);
  CHECK(metal.scene.counters.newton_iterations == 2);
}
