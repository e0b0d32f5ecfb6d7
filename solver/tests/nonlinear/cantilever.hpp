// A cantilever in large displacements, which Newton's method does not bend in one step.
#pragma once

#include "scene.hpp"

namespace comma::solver::testing {

/// Bent by an imposed deflection of half its length within one unit of time.
struct Cantilever {
  Scene scene;
  Scene::Block block;

  Cantilever() : block(scene.block("b", {0, 0}, {10, 1}, 10, 2, 1e6, 0.3)) {
    for (const auto& row : block.nodes) {
      scene.impose({row.front()}, Component::dx, 0.0);
      scene.impose({row.front()}, Component::dy, 0.0);
    }
    scene.impose({block.nodes[1].back()}, Component::dy, -5.0, true);
    scene.problem.behaviours = std::make_shared<const BehaviourOfCells>(
        static_cast<std::size_t>(scene.mesh->cell_count()), CellBehaviour{Kinematics::green_lagrange});
  }

  /// DX of the tip at the last instant.
  double solve(const StepPlan& plan, const NewtonOptions& options, const IterationObserver& observer = {}) {
    solve_static(scene.problem, plan, options, scene.result, scene.counters, observer);
    return scene.displacement(block.nodes[1].back(), Component::dx);
  }

  /// The same, tightly.
  double solve(const StepPlan& plan, int most_iterations, const IterationObserver& observer = {}) {
    NewtonOptions options;
    options.relative_residual = 1e-9;
    options.max_iterations = most_iterations;
    return solve(plan, options, observer);
  }
};

}  // namespace comma::solver::testing
