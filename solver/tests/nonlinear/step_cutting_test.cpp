#include <catch2/catch.hpp>

#include "cantilever.hpp"
#include "solver/error.hpp"

using namespace comma::solver;
using comma::solver::testing::Cantilever;

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
  plan.adaptation->rules[0].few_iterations = 12;
  Cantilever adapted;
  adapted.solve(plan, 20);
  CHECK(adapted.scene.result.steps.back().instant == 1.0);
  CHECK(adapted.scene.result.steps.size() < 15);
}
