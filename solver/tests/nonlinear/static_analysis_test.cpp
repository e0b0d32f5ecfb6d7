#include "solver/nonlinear/static_analysis.hpp"

#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace static_analysis_test {

std::string code_of(Scene& scene, int steps, std::string* message = nullptr, const NewtonOptions& options = {}) {
  try {
    scene.solve(steps, options);
  } catch (const Error& error) {
    if (message) *message = error.what();
    return error.code();
  }
  return "none";
}

FieldFunction constant(double value) {
  return [value](const Point&, double) { return value; };
}

double sum(const Scene& scene, const std::vector<int>& nodes, const std::string& component) {
  double total = 0.0;
  for (const int node : nodes)
    if (const double value = scene.contact(node, component); !std::isnan(value)) total += value;
  return total;
}

TEST_CASE("A block on a unilateral support: the reactions carry the load") {
  Scene scene;
  const auto block = scene.block("b", {0, 0}, {4, 2}, 8, 4, 1e7, 0.3);
  scene.impose({block.nodes[0][0]}, Component::dx, 0);
  scene.ground_spring("k", block.nodes[0][4], 0, 10);   // holds the block against lifting off,
  scene.ground_spring("k2", block.nodes[0][8], 0, 10);  // and against turning
  for (const int node : block.nodes[4]) scene.force(node, Component::dy, -100);
  scene.bound(block.nodes[0], Component::dy, -1.0, constant(0.0));
  scene.solve(1);
  double reaction = 0.0;
  for (const int node : block.nodes[0]) {
    CHECK(scene.displacement(node, Component::dy) >= -1e-14);
    CHECK(scene.internal_force(node, Component::dy) >= -1e-6);
    reaction += scene.internal_force(node, Component::dy);
  }
  CHECK(reaction == Approx(900.0).epsilon(1e-10));
}

TEST_CASE("Pulled off its unilateral support the block flies") {
  Scene scene;
  const auto block = scene.block("b", {0, 0}, {1, 1}, 2, 2, 1e7, 0.3);
  scene.impose({block.nodes[0][0], block.nodes[2][0]}, Component::dx, 0);
  scene.ground_spring("k", block.nodes[2][1], 0, 10);
  scene.force(block.nodes[2][1], Component::dy, 5);
  scene.bound(block.nodes[0], Component::dy, -1.0, constant(0.0));
  scene.solve(1);
  for (const int node : block.nodes[0]) {
    CHECK(scene.displacement(node, Component::dy) == Approx(0.5).epsilon(1e-6));
    CHECK(std::abs(scene.internal_force(node, Component::dy)) < 1e-8);
  }
}

TEST_CASE("A spring that closes a gap: closed form") {
  // Spring k from the ground, pushed by F towards a stop of stiffness s after a gap: u = (F + s gap) / (k + s).
  Scene scene;
  const double k = 100, s = 300, push = 50, gap = 0.1;
  const int left = scene.node("L", 0, 0);
  const int right = scene.node("R", 1, 0);
  scene.ground_spring("k", left, k, 1);
  scene.ground_spring("s", right, s, 1);
  scene.force(left, Component::dx, push);
  UnilateralCondition condition;
  condition.nodes = {left};
  condition.components = {Component::dx};
  condition.coefficients = {constant(1.0)};
  condition.bound = constant(gap);
  scene.problem.unilateral.push_back(condition);
  SECTION("rigid stop") {
    scene.solve(1);
    CHECK(scene.displacement(left, Component::dx) == Approx(gap).epsilon(1e-14));
    CHECK(push - scene.internal_force(left, Component::dx) == Approx(push - k * gap).epsilon(1e-13));
  }
  SECTION("soft stop") {
    scene.problem.unilateral[0].penalty = s;
    scene.solve(2);
    const double expected = (push + s * gap) / (k + s);
    for (const int step : {1, 2})
      CHECK(scene.displacement(left, Component::dx, step) == Approx(expected).epsilon(1e-13));
    CHECK(push - scene.internal_force(left, Component::dx) == Approx(s * (expected - gap)).epsilon(1e-12));
    // Without it the node would be 0.4 beyond.
    for (const double penalty : {s, 1e6 * s}) {
      scene.problem.unilateral[0].penalty = penalty;
      Result again;
      const auto doubts = solve_static(scene.problem, StepPlan({0.0, 1.0}), {}, again, scene.counters).all();
      REQUIRE(doubts.size() == (penalty == s ? 1 : 0));
      if (doubts.empty()) continue;
      CHECK(doubts[0].kind == DoubtKind::soft_bound);
      CHECK(doubts[0].length == Approx(expected - gap));
      CHECK(doubts[0].share == Approx((expected - gap) / (push / k - gap)));
      CHECK(doubts[0].wanted == Approx(1e5));
    }
  }
  SECTION("soft stop that the node is pushed beyond") {
    scene.problem.unilateral[0].penalty = s;
    scene.impose({left}, Component::dx, 2 * gap);
    CHECK_NOTHROW(scene.solve(1));
    CHECK(scene.displacement(left, Component::dx) == exactly(2 * gap));
  }
  SECTION("out of reach") {
    scene.problem.unilateral[0].bound = constant(0.6);
    scene.solve(1);
    CHECK(scene.displacement(left, Component::dx) == Approx(push / k).epsilon(1e-14));
  }
}

TEST_CASE("A bound that follows time lets go when it moves away") {
  Scene scene;
  const int node = scene.node("P", 0, 0);
  scene.ground_spring("k", node, 1, 100);
  scene.force(node, Component::dy, 10);  // free: 0.1
  scene.bound({node}, Component::dy, 1.0, [](const Point&, double t) { return 0.04 * t; });
  scene.solve(4);
  for (int t = 1; t <= 4; ++t)
    CHECK(scene.displacement(node, Component::dy, t) == Approx(std::min(0.04 * t, 0.1)).epsilon(1e-13));
  CHECK(scene.counters.factorisations == 1);
}

TEST_CASE("Contact of two blocks across a gap: closed form in series") {
  // Bars of equal section (nu = 0): the upper one is pushed by 0.3 over a gap of 0.1; each takes half of the remaining
  // 0.2.
  Scene scene;
  const auto lower = scene.block("l", {0, 0}, {1, 2}, 2, 2, 1000, 0);
  const auto upper = scene.block("u", {0, 2.1}, {1, 2}, 2, 2, 1000, 0);
  scene.impose(lower.nodes[0], Component::dy, 0);
  scene.impose({lower.nodes[0][0], upper.nodes[2][0]}, Component::dx, 0);
  scene.impose(upper.nodes[2], Component::dy, -0.1, true);
  scene.zone(lower.top, upper.bottom);
  scene.solve(3);
  for (const int node : upper.nodes[0])
    CHECK(scene.displacement(node, Component::dy, 1) == Approx(-0.1).epsilon(1e-12));
  for (const int node : lower.nodes[2]) CHECK(scene.displacement(node, Component::dy, 1) == Approx(0.0).margin(1e-13));
  for (const int node : lower.nodes[2]) CHECK(scene.displacement(node, Component::dy) == Approx(-0.1).epsilon(1e-12));
  for (const int node : upper.nodes[0]) CHECK(scene.contact(node, "JEU") == Approx(0.0).margin(1e-13));
  CHECK(sum(scene, upper.nodes[0], "RN") == Approx(1000 * 0.1 / 2.0).epsilon(1e-12));
  CHECK(scene.counters.factorisations == 1);
}

TEST_CASE("Contact on meshes that do not match: the resultant is exact, the pressure nearly so") {
  Scene scene;
  const auto lower = scene.block("l", {0, 0}, {6, 2}, 7, 3, 1000, 0);
  const auto upper = scene.block("u", {0, 2}, {6, 2}, 4, 3, 1000, 0);
  scene.impose(lower.nodes[0], Component::dy, 0);
  scene.impose({lower.nodes[0][0], upper.nodes[3][0]}, Component::dx, 0);
  scene.impose(upper.nodes[3], Component::dy, -0.04);
  scene.zone(lower.top, upper.bottom);
  scene.solve(1);
  const double pressure = 1000 * 0.04 / 4.0;
  double support = 0.0;
  for (const int node : lower.nodes[0]) support += scene.internal_force(node, Component::dy);
  // Action and reaction to rounding; node-to-facet contact is no patch test, so the pressure itself is some percent
  // off.
  CHECK(-sum(scene, upper.nodes[0], "RNY") == Approx(support).epsilon(1e-11));
  CHECK(support == Approx(6 * pressure).epsilon(0.05));
}

TEST_CASE("Contact on meshes that match passes the patch test") {
  Scene scene;
  const auto lower = scene.block("l", {0, 0}, {6, 2}, 4, 3, 1000, 0.25);
  const auto upper = scene.block("u", {0, 2}, {6, 2}, 4, 2, 1000, 0.25);
  scene.impose(lower.nodes[0], Component::dy, 0);
  scene.impose({lower.nodes[0][0], upper.nodes[2][0]}, Component::dx, 0);
  scene.impose(upper.nodes[2], Component::dy, -0.04);
  scene.zone(lower.top, upper.bottom);
  scene.problem.contact->geometry_update = GeometryUpdate::none;
  scene.solve(1);
  const double stress = 1000 / (1 - 0.0625) * 0.01;
  for (std::size_t i = 0; i < 5; ++i) {
    const double share = i == 0 || i == 4 ? 0.75 : 1.5;
    CHECK(-scene.contact(upper.nodes[0][i], "RNY") == Approx(stress * share).epsilon(1e-10));
    CHECK(scene.displacement(upper.nodes[0][i], Component::dy) == Approx(-0.02).epsilon(1e-10));
  }
}

TEST_CASE(
    "Iterations count on from one update of the geometry to the next in the discrete formulation, and begin again in "
    "the mixed one") {
  for (const ContactFormulation formulation : {ContactFormulation::discrete, ContactFormulation::mixed}) {
    Scene scene;
    const auto lower = scene.block("l", {0, 0}, {6, 2}, 4, 2, 1000, 0.25);
    const auto upper = scene.block("u", {0, 2}, {6, 2}, 5, 2, 1000, 0.25);
    scene.impose(lower.nodes[0], Component::dy, 0);
    scene.impose({lower.nodes[0][0], upper.nodes[2][0]}, Component::dx, 0);
    scene.impose(upper.nodes[2], Component::dy, -0.4);
    scene.zone(lower.top, upper.bottom);
    scene.problem.contact->formulation = formulation;
    scene.problem.contact->geometry_update = GeometryUpdate::controlled;
    scene.problem.contact->controlled_updates = 3;
    std::vector<int> numbers;
    scene.solve(1, {}, [&](const IterationReport& report) { numbers.push_back(report.iteration); });
    REQUIRE(numbers.size() == 3);  // linear bodies: one an update
    CHECK(numbers.back() == (formulation == ContactFormulation::discrete ? 3 : 1));
  }
}

TEST_CASE("Bodies that stay apart do not feel each other") {
  Scene scene;
  const auto lower = scene.block("l", {0, 0}, {1, 1}, 1, 1, 1000, 0.3);
  const auto upper = scene.block("u", {0, 2}, {1, 1}, 1, 1, 1000, 0.3);
  scene.impose(lower.nodes[0], Component::dy, 0);
  scene.impose({lower.nodes[0][0], upper.nodes[1][0]}, Component::dx, 0);
  scene.impose(upper.nodes[1], Component::dy, -0.1, true);
  scene.zone(lower.top, upper.bottom);
  scene.solve(5);
  CHECK(scene.contact(upper.nodes[0][0], "CONT") == 0.0);
  CHECK(scene.contact(upper.nodes[0][0], "JEU") == Approx(0.5).epsilon(1e-12));
  CHECK(scene.contact(upper.nodes[0][0], "RN") == 0.0);
  CHECK(std::abs(scene.internal_force(lower.nodes[1][0], Component::dy)) < 1e-12);
}

TEST_CASE("Conditions that exclude each other name their nodes") {
  Scene scene;
  const int node = scene.node("P", 0, 0);
  scene.ground_spring("k", node, 1, 100);
  scene.bound({node}, Component::dy, 1.0, constant(-1.0));   // DY <= -1
  scene.bound({node}, Component::dy, -1.0, constant(-2.0));  // DY >= 2
  std::string message;
  CHECK(code_of(scene, 1, &message) == "contradictory-conditions");
  CHECK(message.find("1*DY(P) <= -1") != std::string::npos);
  CHECK(message.find("-1*DY(P) <= -2") != std::string::npos);
}

TEST_CASE("An imposed displacement beyond a bound names the bound and the node") {
  Scene scene;
  const int node = scene.node("P", 0, 0);
  scene.ground_spring("k", node, 1, 100);
  scene.impose({node}, Component::dy, -0.5, true);
  scene.bound({node}, Component::dy, -1.0, constant(1.2));  // DY >= -1.2, passed at t = 3
  std::string message;
  CHECK(code_of(scene, 5, &message) == "contradictory-conditions");
  CHECK(message.find("DY(P)") != std::string::npos);
  CHECK(scene.result.steps.size() == 3);  // t = 0, 1, 2 stay readable
}

TEST_CASE("The same condition written twice, and on a held node, changes nothing") {
  Scene scene;
  const int node = scene.node("P", 0, 0);
  const int held = scene.node("Q", 1, 0);
  scene.ground_spring("k", node, 1, 100);
  scene.ground_spring("q", held, 1, 1);
  scene.impose({held}, Component::dy, 0);
  scene.force(node, Component::dy, -10);
  for (int copy = 0; copy < 3; ++copy)
    scene.bound({node, held}, Component::dy, -1.0 - copy, constant(0.02 * (1.0 + copy)));
  scene.solve(2);
  CHECK(scene.displacement(node, Component::dy) == Approx(-0.02).epsilon(1e-13));
}

TEST_CASE("A body that nothing holds is named") {
  Scene scene;
  const auto block = scene.block("b", {0, 0}, {1, 1}, 1, 1, 1000, 0.3);
  scene.impose(block.nodes[0], Component::dy, 0);
  scene.impose({block.nodes[1][0]}, Component::dy, 0);
  std::string message;
  CHECK(code_of(scene, 1, &message) == "singular-matrix");
  CHECK(message.find("translation along X") != std::string::npos);
}

TEST_CASE("Contradictory imposed displacements are an error, the same one twice is not") {
  Scene scene;
  const int node = scene.node("P", 0, 0);
  scene.ground_spring("k", node, 1, 100);
  scene.impose({node}, Component::dy, 1.0);
  scene.impose({node}, Component::dy, 1.0);
  SECTION("twice") {
    scene.solve(1);
    CHECK(scene.displacement(node, Component::dy) == Approx(1.0).epsilon(1e-15));
  }
  SECTION("contradictory") {
    scene.impose({node}, Component::dy, 2.0);
    CHECK(code_of(scene, 1) == "contradictory-conditions");
  }
}

TEST_CASE("A limit below rounding ends with the residuals it reached, earlier steps kept") {
  Scene scene;
  const auto block = scene.block("b", {0, 0}, {1, 1}, 3, 3, 2e11, 0.3);
  scene.impose(block.nodes[0], Component::dx, 0);
  scene.impose(block.nodes[0], Component::dy, 0);
  scene.impose(block.nodes[3], Component::dy, 1e-3, true);
  NewtonOptions options;
  options.relative_residual.reset();
  options.absolute_residual = 1e-30;
  options.max_iterations = 4;
  std::string message;
  CHECK(code_of(scene, 2, &message, options) == "no-convergence");
  CHECK(message.find("t = 1") != std::string::npos);
  CHECK(scene.result.steps.size() == 1);
}

TEST_CASE("A step without any load converges to nothing") {
  Scene scene;
  const auto block = scene.block("b", {0, 0}, {1, 1}, 1, 1, 1000, 0.3);
  scene.impose(block.nodes[0], Component::dx, 0);
  scene.impose(block.nodes[0], Component::dy, 0);
  scene.solve(2);
  CHECK(scene.displacement(block.nodes[1][1], Component::dy) == 0.0);
}

TEST_CASE("A linear scene costs one factorisation, one iteration a step, and reports each") {
  Scene scene;
  const auto block = scene.block("b", {0, 0}, {1, 1}, 4, 4, 1000, 0.3);
  scene.impose(block.nodes[0], Component::dx, 0);
  scene.impose(block.nodes[0], Component::dy, 0);
  scene.impose(block.nodes[4], Component::dy, -0.01, true);
  int reports = 0;
  scene.solve(6, {}, [&](const IterationReport& report) {
    ++reports;
    CHECK(report.relative_residual < 1e-12);
    CHECK(report.worst.find(" at b") != std::string::npos);
  });
  CHECK(reports == 6);
  CHECK(scene.counters.factorisations == 1);
  CHECK(scene.counters.newton_iterations == 6);
  CHECK(scene.counters.solves <= 6 * 4);
  for (int t = 1; t <= 6; ++t) CHECK(scene.displacement(block.nodes[4][2], Component::dy, t) == exactly(-0.01 * t));
}

TEST_CASE("A result that has steps is gone on with") {
  Scene scene;
  const int node = scene.node("P", 0, 0);
  scene.ground_spring("k", node, 1, 100);
  scene.impose({node}, Component::dy, 1.0, true);
  scene.solve(2);
  solve_static(scene.problem, StepPlan({2.0, 3.0}), {}, scene.result, scene.counters);
  REQUIRE(scene.result.steps.size() == 4);
  CHECK(scene.result.steps.back().order == 3);
  CHECK(scene.displacement(node, Component::dy) == exactly(3.0));
}

TEST_CASE("Where a step is guessed to end does not change which places face each other at first") {
  // A flat block tips as it is pressed; one update of the geometry leaves in the result which geometry was the first.
  for (const ContactFormulation formulation : {ContactFormulation::discrete, ContactFormulation::mixed}) {
    const auto tip = [&](StepGuess guess) {
      Scene scene;
      const auto lower = scene.block("l", {0, 0}, {6, 2}, 6, 2, 1000, 0.25);
      const auto upper = scene.block("u", {1, 2}, {3, 2}, 4, 2, 1000, 0.25);
      scene.impose(lower.nodes[0], Component::dx, 0);
      scene.impose(lower.nodes[0], Component::dy, 0);
      scene.impose(upper.nodes[2], Component::dx, 0.3, true);
      scene.impose(upper.nodes[2], Component::dy, -0.1, true);
      scene.zone(lower.top, upper.bottom);
      scene.problem.contact->formulation = formulation;
      scene.problem.contact->geometry_update = GeometryUpdate::controlled;
      scene.problem.contact->controlled_updates = 1;
      NewtonOptions options;
      options.guess = guess;
      scene.solve(3, options);
      return scene.displacement(upper.nodes[0][4], Component::dy);
    };
    CHECK(tip(StepGuess::extrapolate) == Approx(tip(StepGuess::stay)).epsilon(1e-9));
  }
}

TEST_CASE("Geometry updates follow a sliding block to the next facet") {
  // A stiff block slides over a stepped row of facets while pressed down: each slave node ends on the facet under it.
  Scene scene;
  const auto table = scene.block("t", {0, 0}, {10, 1}, 10, 1, 1e6, 0);
  const auto block = scene.block("s", {1.25, 1}, {0.5, 0.5}, 1, 1, 1e6, 0);
  scene.impose(table.nodes[0], Component::dx, 0);
  scene.impose(table.nodes[0], Component::dy, 0);
  scene.impose(block.nodes[1], Component::dx, 1.0, true);
  scene.impose(block.nodes[1], Component::dy, -0.001);
  scene.zone(table.top, block.bottom);
  scene.solve(5);
  for (const int node : block.nodes[0]) {
    CHECK(scene.contact(node, "CONT") == 2.0);
    CHECK(scene.contact(node, "PROJ_X") == Approx(scene.contact(node, "PT_X")).margin(1e-4));
  }
  CHECK(sum(scene, block.nodes[0], "RN") > 0.0);
  CHECK(scene.counters.factorisations == 1);
  CHECK(scene.counters.pairings >= 6);
}

}  // namespace static_analysis_test
