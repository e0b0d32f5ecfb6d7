#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/nonlinear/cantilever.hpp"

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

TEST_CASE("a step that fails says why and what is tried next; where it may not be cut again, the last one says so") {
  StepPlan plan({0.0, 1.0});
  plan.cutting = StepCutting{2, 2, 0.0};
  constexpr int hardly_any = 2;
  std::vector<std::string> told, details;
  const auto listen = [&](const IterationReport& report) {
    if (report.event.empty()) return;
    told.push_back(report.event);
    details.push_back(report.detail);
  };
  CHECK_THROWS_WITH(Cantilever().solve(plan, hardly_any, listen),
                    Catch::Contains("t = 0.25") && Catch::Contains("the step has been cut 2 times, and may not be"));
  CHECK(told == std::vector<std::string>{"step to 1 fails (no convergence): cut, on to 0.5",
                                         "step to 0.5 fails (no convergence): cut, on to 0.25"});
  for (const std::string& detail : details) {
    CHECK_THAT(detail, Catch::StartsWith("no convergence at t = "));
    CHECK(detail.find('\n') == std::string::npos);
  }
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
