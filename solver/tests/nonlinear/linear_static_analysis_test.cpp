#include "solver/nonlinear/linear_static_analysis.hpp"

#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace linear_static_analysis_test {

constexpr double young = 2e11;
constexpr double poisson = 0.3;

struct Solved {
  Result result;
  Counters counters;
};

Solved solve(const StaticProblem& problem, std::vector<double> instants) {
  Solved solved;
  solve_linear_static(problem, instants, {}, solved.result, solved.counters);
  return solved;
}

double value(const Result& result, std::size_t step, std::string_view field, int place, std::string_view component) {
  const Field& found = result.steps[step].fields.find(field)->second;
  if (const auto* nodal = std::get_if<NodalField>(&found)) return nodal->at(place, nodal->component(component));
  const auto& element = std::get<ElementField>(found);
  return element.at(place, 0, element.component(component));
}

/// A plate held along its left side in x and at one corner in y.
struct Plate {
  Scene scene;
  Scene::Block block;

  explicit Plate(Property modulus = young, double expansion = 0.0)
      : block(scene.block("b", {0, 0}, {4, 2}, 4, 2, young, poisson)) {
    for (const auto& row : block.nodes) scene.impose({row.front()}, Component::dx, 0.0);
    scene.impose({block.nodes[0][0]}, Component::dy, 0.0);
    Material material;
    IsotropicElasticity elasticity{std::move(modulus), poisson};
    elasticity.expansion = expansion;
    material.elasticity = elasticity;
    auto materials = std::make_shared<MaterialField>();
    materials->by_cell.assign(scene.mesh->cell_types.size(), std::make_shared<const Material>(material));
    scene.problem.materials = materials;
  }

  /// Temperatures at times 0 and 10, from a reference of 0.
  void heat(double first, double second) {
    const auto uniform = [&](double temperature) {
      return std::make_shared<const Field>(
          NodalField{"TEMP_R", {"TEMP"}, std::vector<double>(scene.mesh->nodes.size(), temperature)});
    };
    CommandVariable variable;
    variable.reference = 0.0;
    variable.snapshots = {{0.0, uniform(first)}, {10.0, uniform(second)}};
    auto materials = std::make_shared<MaterialField>(*scene.problem.materials);
    materials->variables = {variable};
    scene.problem.materials = materials;
  }

  void pull(double force) {
    for (std::size_t row = 0; row < block.nodes.size(); ++row) {
      const bool end = row == 0 || row + 1 == block.nodes.size();
      scene.force(block.nodes[row].back(), Component::dx, end ? force / 2 : force);
    }
  }

  int corner() const { return block.nodes.back().back(); }
};

TEST_CASE("linear statics: several instants, one factorisation, orders from 1 on", "[linear-statics]") {
  Plate plate;
  plate.pull(1e6);
  const auto [result, counters] = solve(plate.scene.problem, {0.0, 1.0, 5.0});
  CHECK(counters.factorisations == 1);
  REQUIRE(result.steps.size() == 3);
  CHECK(result.steps[0].order == 1);
  CHECK(result.steps[2].order == 3);
  // Uniform tension: 2e6 N on a side of 2 m.
  CHECK(value(result, 2, "DEPL", plate.corner(), "DX") == exactly(1e6 * (1 - poisson * poisson) / young * 4));
  CHECK(value(result, 2, "SIEF_ELGA", 0, "SIXX") == exactly(1e6));
}

TEST_CASE("linear statics: free thermal expansion has no stress in the plane, and grows with the temperature",
          "[linear-statics]") {
  Plate plate(young, 1e-5);
  plate.heat(0.0, 100.0);
  const auto [result, counters] = solve(plate.scene.problem, {5.0, 10.0});
  CHECK(counters.factorisations == 1);
  const double stretch = 1e-5 * (1 + poisson);
  CHECK(value(result, 0, "DEPL", plate.corner(), "DX") == exactly(stretch * 50 * 4));
  CHECK(value(result, 1, "DEPL", plate.corner(), "DY") == exactly(stretch * 100 * 2));
  CHECK(value(result, 1, "SIEF_ELGA", 3, "SIXX") == Approx(0.0).margin(1e-6));
  CHECK(value(result, 1, "SIEF_ELGA", 3, "SIZZ") == exactly(-young * 1e-3));
}

TEST_CASE("linear statics: a modulus that changes with temperature is factorised again at each instant",
          "[linear-statics]") {
  const Property softening([](const MaterialPoint& at) { return young * (1 - at[Parameter::temperature] / 200); });
  Plate plate(softening);
  plate.heat(0.0, 100.0);
  plate.pull(1e6);
  const auto [result, counters] = solve(plate.scene.problem, {0.0, 10.0});
  CHECK(counters.factorisations == 2);
  const double cold = value(result, 0, "DEPL", plate.corner(), "DX");
  CHECK(value(result, 1, "DEPL", plate.corner(), "DX") == exactly(2 * cold));
}

TEST_CASE("linear statics and Newton agree on a thermal scene with imposed displacements", "[linear-statics]") {
  const Property softening([](const MaterialPoint& at) { return young * (1 - at[Parameter::temperature] / 200); });
  Plate plate(softening, 1e-5);
  plate.heat(0.0, 100.0);
  plate.scene.impose({plate.corner()}, Component::dx, 1e-3, true);
  const auto [result, counters] = solve(plate.scene.problem, {1.0, 2.0});
  plate.scene.solve(2);
  for (const int node : plate.block.nodes[1]) {
    for (const auto component : {Component::dx, Component::dy}) {
      CHECK(value(result, 1, "DEPL", node, name_of(component)) ==
            Approx(plate.scene.displacement(node, component)).margin(1e-15));
    }
  }
}

TEST_CASE("linear statics takes no unilateral conditions", "[linear-statics]") {
  Plate plate;
  plate.scene.bound({plate.corner()}, Component::dx, 1.0, [](const Point&, double) { return 0.0; });
  CHECK_THROWS_WITH(solve(plate.scene.problem, {0.0}), Catch::Contains("unilateral"));
}

TEST_CASE("linear statics without a test of pivots: loads that nothing bears are told by what is out of balance",
          "[linear-statics]") {
  Scene scene;
  const auto block = scene.block("b", {0, 0}, {4, 2}, 4, 2, young, poisson);
  for (const auto& row : block.nodes) scene.impose({row.front()}, Component::dx, 0.0);
  scene.force(block.nodes[1].back(), Component::dx, 1e6);
  Solved solved;
  LinearStaticOptions options;
  options.linear.singular_digits = -1;
  CHECK_NOTHROW(solve_linear_static(scene.problem, std::array{0.0}, options, solved.result, solved.counters));
  CHECK(value(solved.result, 0, "SIEF_ELGA", 0, "SIXX") > 0.0);
  scene.force(block.nodes[1].back(), Component::dy, 1e6);
  CHECK_THROWS_WITH(solve_linear_static(scene.problem, std::array{1.0}, options, solved.result, solved.counters),
                    Catch::Contains("out of balance"));
}

TEST_CASE("a stiffness that is not positive definite is counted", "[linear-statics]") {
  Scene scene;
  const int free = scene.node("A", 0, 0);
  scene.ground_spring("S1", free, 1e3, 1e3);
  scene.force(free, Component::dx, 1.0);
  CHECK(solve(scene.problem, {0.0}).counters.indefinite_factorisations == 0);
  scene.ground_spring("S2", free, -3e3, 1e3);
  const auto [result, counters] = solve(scene.problem, {0.0});
  CHECK(counters.indefinite_factorisations == 1);
  CHECK(counters.indefinite_solutions == 1);
  CHECK(value(result, 0, "DEPL", free, "DX") == exactly(1.0 / (1e3 - 3e3)));
}

}  // namespace linear_static_analysis_test
