#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/error.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace {

/// A cantilever in large displacements, bent by an imposed deflection of half its length within one unit of time.
struct Cantilever {
  Scene scene;
  Scene::Block block;

  Cantilever() : block(scene.block("b", {0, 0}, {10, 1}, 10, 2, 1e6, 0.3)) {
    for (const auto& row : block.nodes) {
      scene.impose({row.front()}, Component::dx, 0.0);
      scene.impose({row.front()}, Component::dy, 0.0);
    }
    scene.impose({block.nodes[1].back()}, Component::dy, -5.0, true);
    scene.problem.behaviours = std::make_shared<const BehaviourOfCells>(static_cast<std::size_t>(scene.mesh->cell_count()), CellBehaviour{Kinematics::green_lagrange});
  }

  /// DX of the tip at the last instant.
  double solve(const StepPlan& plan, int most_iterations, const IterationObserver& observer = {}) {
    NewtonOptions options;
    options.relative_residual = 1e-9;
    options.max_iterations = most_iterations;
    solve_static(scene.problem, plan, options, scene.result, scene.counters, observer);
    return scene.displacement(block.nodes[1].back(), Component::dx);
  }
};

}  // namespace

TEST_CASE("a step too long for Newton's method fails; cut into parts it arrives where many small steps do") {
  StepPlan plan({0.0, 1.0});
  constexpr int few = 6;
  CHECK_THROWS_WITH(Cantilever().solve(plan, few), Catch::Contains("no convergence"));
  plan.cutting = StepCutting{};
  Cantilever cut;
  int cuts = 0;
  const double arrived = cut.solve(plan, few, [&](const IterationReport& report) { cuts += !report.event.empty(); });
  CHECK(cuts > 0);
  CHECK(cut.scene.result.steps.back().instant == 1.0);
  CHECK(cut.scene.result.steps.size() > 2);
  // Elasticity forgets the path.
  std::vector<double> many;
  for (int k = 0; k <= 20; ++k) many.push_back(k / 20.0);
  CHECK(arrived == Approx(Cantilever().solve(StepPlan(many), 20)).epsilon(1e-8));
  // An arc of constant length: the tip comes back by about 0.6 w^2 / L.
  CHECK(arrived < -1.0);
}

TEST_CASE("steps that adapt meet the end, in fewer steps as they go well") {
  StepPlan plan({0.0, 0.05, 1.0});
  plan.adaptation = StepAdaptation{};
  plan.adaptation->few_iterations = 12;
  Cantilever adapted;
  adapted.solve(plan, 20);
  CHECK(adapted.scene.result.steps.back().instant == 1.0);
  CHECK(adapted.scene.result.steps.size() < 15);
}
