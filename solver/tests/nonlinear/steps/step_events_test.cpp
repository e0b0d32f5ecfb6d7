#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/nonlinear/iterations/residual_watch.hpp"
#include "solver/tests/exactly.hpp"
#include "solver/tests/nonlinear/cantilever.hpp"
#include "solver/tests/nonlinear/scene.hpp"

using namespace comma::solver;
using comma::solver::testing::Cantilever;
using comma::solver::testing::Scene;

namespace {

StepEvent event_of(StepEventKind kind, double limit = 0.0) {
  StepEvent event;
  event.kind = kind;
  event.limit = limit;
  return event;
}

std::vector<IterationReport> history_of(const std::vector<double>& residuals) {
  std::vector<IterationReport> history;
  for (const double residual : residuals) {
    history.emplace_back();
    history.back().iteration = static_cast<int>(history.size());
    history.back().absolute_residual = residual;
  }
  return history;
}

std::vector<double> instants_of(const Result& result) {
  std::vector<double> instants;
  for (const ResultStep& step : result.steps) instants.push_back(step.instant);
  return instants;
}

/// Two blocks a gap apart, the upper one pushed down by 0.22 within one unit of time: they meet at 0.1 / 0.22.
struct Falling {
  static constexpr double meets = 0.1 / 0.22;
  Scene scene;
  Scene::Block lower, upper;

  explicit Falling(ContactFormulation formulation)
      : lower(scene.block("l", {0, 0}, {3, 1}, 3, 1, 2e5, 0.0)),
        upper(scene.block("u", {0, 1.1}, {3, 1}, 3, 1, 2e5, 0.0)) {
    for (const int node : lower.nodes.front()) scene.impose({node}, Component::dy, 0);
    scene.impose({lower.nodes[0][0], upper.nodes[0][0]}, Component::dx, 0);
    scene.impose(upper.nodes.back(), Component::dy, -0.22, true);
    scene.zone(lower.top, upper.bottom);
    scene.problem.contact->formulation = formulation;
  }

  MixedZone& zone() { return scene.problem.contact->zones.front().mixed; }
  void solve(const StepPlan& plan) { solve_static(scene.problem, plan, {}, scene.result, scene.counters); }
};

/// The length of the step in which they meet.
double meeting_step(const Result& result) {
  const std::vector<double> instants = instants_of(result);
  const auto after = std::ranges::find_if(instants, [](double each) { return each > Falling::meets; });
  return *after - *(after - 1);
}

}  // namespace

TEST_CASE("residuals that grow twice, or beyond a limit, end a step where that is asked for") {
  ResidualWatch watch;
  look_at_residuals(watch, history_of({1.0, 2.0, 3.0}));
  watch.stops_divergence = true;
  look_at_residuals(watch, history_of({1.0, 2.0}));
  look_at_residuals(watch, history_of({1.0, 2.0, 0.5}));
  look_at_residuals(watch, history_of({5.0, 1.0, 2.0}));
  CHECK_THROWS_WITH(look_at_residuals(watch, history_of({1.0, 3.0, 2.0})),
                    Catch::Contains("grows, from 1.000e+00 to 2.000e+00 in iteration 3"));
  watch.largest = 4.0;
  look_at_residuals(watch, history_of({4.0}));
  CHECK_THROWS_WITH(look_at_residuals(watch, history_of({4.1})), Catch::Contains("RESI_GLOB_MAXI = 4"));
}

/// Code_Aster 17.3 expects 33 from the first ten on, 12 from the other series.
TEST_CASE("residuals promise an end along the line that fits them") {
  const std::vector<double> slow = {2.58876e-1, 1.89235e-1, 1.27514e-1, 8.49958e-2, 5.72966e-2,
                                    3.8967e-2,  2.66144e-2, 1.82347e-2, 1.25195e-2, 8.60843e-3};
  CHECK(expected_iterations(slow, 1e-6) == 33);
  CHECK(expected_iterations(std::span(slow).first(7), 1e-6) == 32);
  CHECK_FALSE(expected_iterations(std::span(slow).first(6), 1e-6));
  const std::vector<double> fast = {1.05694e-2, 5.05622e-3, 2.34649e-3, 1.07566e-3, 4.92037e-4,
                                    2.24936e-4, 1.02804e-4, 4.69784e-5, 2.14661e-5, 9.80817e-6};
  CHECK(expected_iterations(fast, 1e-6) == 12);
  CHECK_FALSE(expected_iterations(std::vector<double>(8, 1.0), 1e-3));
}

TEST_CASE("what looks on may take the watched field away from the result") {
  StepPlan plan({0.0, 1.0});
  plan.events.push_back(event_of(StepEventKind::increment));
  plan.events.front().increment = WatchedIncrement{"SIEF_ELGA", "SIYY", {}, {}, 1e3};
  plan.events.front().cutting = StepCutting{};
  plan.adaptation.emplace().rules.front().increment = WatchedIncrement{"DEPL", "DY", {}, {}, 0.05};
  plan.adaptation->rules.front().always = true;
  Scene kept, bared;
  for (Scene* scene : {&kept, &bared}) {
    const Scene::Block block = scene->block("b", {0, 0}, {3, 1}, 3, 1, 2e5, 0.0);
    for (const int node : block.nodes.front()) scene->impose({node}, Component::dy, 0);
    scene->impose({block.nodes[0][0]}, Component::dx, 0);
    scene->impose(block.nodes.back(), Component::dy, -0.1, true);
  }
  solve_static(kept.problem, plan, {}, kept.result, kept.counters);
  solve_static(bared.problem, plan, {}, bared.result, bared.counters, {}, [](Result& result) {
    result.steps.back().fields.erase("DEPL");
    result.steps.back().fields.erase("SIEF_ELGA");
  });
  CHECK(kept.result.steps.size() > 3);
  CHECK(instants_of(bared.result) == instants_of(kept.result));
}

TEST_CASE("a step that changes a field too much is cut until it does not") {
  StepPlan plan({0.0, 1.0});
  plan.events.push_back(event_of(StepEventKind::increment));
  plan.events.front().increment = WatchedIncrement{"DEPL", "DY", {}, {}, 1.0};
  CHECK_THROWS_WITH(Cantilever().solve(plan, 30), Catch::Contains("in one step, more than the 1 allowed"));

  plan.events.front().cutting = StepCutting{};
  plan.events.front().cutting->automatic = true;
  Cantilever cut;
  const double arrived = cut.solve(plan, 30);
  const std::vector<double> instants = instants_of(cut.scene.result);
  REQUIRE(instants.back() == 1.0);
  // The deflection grows by 5 a unit of time.
  for (std::size_t k = 1; k < instants.size(); ++k) CHECK(instants[k] - instants[k - 1] <= exactly(0.2));
  CHECK(instants.size() <= 17);
  CHECK(arrived == Approx(Cantilever().solve(StepPlan(instants), 30)).epsilon(1e-8));
}

TEST_CASE("a step whose residual is too large is cut by the rule of that event") {
  StepPlan plan({0.0, 1.0});
  plan.events.push_back(event_of(StepEventKind::residual, 1e4));
  CHECK_THROWS_WITH(Cantilever().solve(plan, 30), Catch::Contains("RESI_GLOB_MAXI"));
  plan.events.front().cutting = StepCutting{5, 3, 0.0};
  Cantilever cut;
  cut.solve(plan, 30);
  CHECK(instants_of(cut.scene.result).size() > 5);
}

TEST_CASE("where residuals shrink fast enough more iterations are allowed") {
  const StepPlan plan({0.0, 0.02});
  NewtonOptions options;
  options.relative_residual = 1e-9;
  options.max_iterations = 200;
  options.tangent.iterations = 0;  // so that they shrink by the same factor each time
  int most = 0;
  const double exact = Cantilever().solve(
      plan, options, [&](const IterationReport& report) { most = std::max(most, report.iteration); });
  REQUIRE(most > 8);
  options.max_iterations = most - 1;
  CHECK_THROWS_WITH(Cantilever().solve(plan, options), Catch::Contains("no convergence"));
  StepPlan patient = plan;
  patient.further_iterations = 1.0;
  std::string told;
  CHECK(Cantilever().solve(patient, options, [&](const IterationReport& report) { told += report.event; }) ==
        Approx(exact).epsilon(1e-12));
  CHECK_THAT(told, Catch::Contains("more iterations are allowed"));
}

TEST_CASE("steps in which contact closes are as short as is asked for") {
  const ContactFormulation formulation = GENERATE(ContactFormulation::discrete, ContactFormulation::mixed);
  StepPlan plan({0.0, 1.0});
  plan.events.push_back(event_of(StepEventKind::collision));
  SECTION("cut into equal parts, to the depth allowed, and then they stand") {
    plan.events.front().cutting = StepCutting{2, 4, 0.0};
    Falling blocks(formulation);
    blocks.solve(plan);
    CHECK(meeting_step(blocks.scene.result) == exactly(1.0 / 16));
    CHECK(blocks.scene.result.steps.size() < 8);
  }
  SECTION("or the computation ends there") {
    Falling blocks(formulation);
    CHECK_THROWS_WITH(blocks.solve(plan), Catch::Contains("close or open in the step to t = 1"));
  }
  SECTION("of a given length, for a while") {
    plan.events.front().around = CollisionSteps{0.02, 0.5};
    Falling blocks(formulation);
    blocks.solve(plan);
    CHECK(meeting_step(blocks.scene.result) == exactly(0.02));
    const std::vector<double> instants = instants_of(blocks.scene.result);
    CHECK(instants[instants.size() - 2] == exactly(0.5));
    CHECK(instants.size() == 27);
  }
}

TEST_CASE("points that are too deep stop the computation or raise the penalty") {
  StepPlan plan({0.0, 1.0});
  plan.events.push_back(event_of(StepEventKind::depth, 1e-3));
  const auto penalised = [](Falling& blocks) {
    blocks.zone().penalised = true;
    blocks.zone().augmentation = 1e5;
  };
  Falling soft(ContactFormulation::mixed);
  penalised(soft);
  CHECK_THROWS_WITH(soft.solve(plan), Catch::Contains("deep, more than the 0.001 allowed"));

  plan.events.front().most_stiffening = 1e6;
  Falling raised(ContactFormulation::mixed);
  penalised(raised);
  raised.solve(plan);
  const double gap = raised.scene.contact(raised.upper.nodes[0][1], "JEU");
  CHECK(gap < 0.0);
  CHECK(gap >= -1e-3);

  plan.events.front().most_stiffening = 2.0;
  Falling bounded(ContactFormulation::mixed);
  penalised(bounded);
  CHECK_THROWS_WITH(bounded.solve(plan), Catch::Contains("a contact penalty 2 times the one given"));

  Falling rigid(ContactFormulation::mixed);
  CHECK_THROWS_WITH(rigid.solve(plan), Catch::Contains("no contact here has a penalty"));
}

TEST_CASE("short steps take the elastic stiffness, made once, and more iterations for it") {
  NewtonOptions options;
  options.relative_residual = 1e-9;
  options.tangent.elastic_below = 0.05;
  options.max_elastic_iterations = 400;
  const StepPlan plan({0.0, 0.01, 0.02});
  Cantilever slow, fast;
  const double crept = slow.solve(plan, options);
  options.tangent.elastic_below = 0.005;
  CHECK(crept == Approx(fast.solve(plan, options)).epsilon(1e-6));
  CHECK(slow.scene.counters.factorisations < fast.scene.counters.factorisations);
  CHECK(slow.scene.counters.newton_iterations > fast.scene.counters.newton_iterations);
}
