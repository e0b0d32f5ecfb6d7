#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "solver/error.hpp"
#include "solver/nonlinear/iterations/line_search.hpp"
#include "solver/tests/exactly.hpp"
#include "solver/tests/nonlinear/scene.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

TEST_CASE("the line search leaves a full step that is good enough, and finds where work vanishes") {
  LineSearch options;
  int calls = 0;
  CHECK(search_line(options, 1.0, [&](double rho) {
          ++calls;
          return 1.0 - rho + 0.05;
        }) == 1.0);
  CHECK(calls == 1);
  options.tolerance = 1e-8;
  options.max_iterations = 50;
  for (const bool bracketed : {false, true}) {
    options.bracketed = bracketed;
    const double rho = search_line(options, 1.0, [](double at) { return std::cos(3.0 * at); });
    CHECK(rho == Approx(M_PI / 6).epsilon(1e-6));
  }
}

TEST_CASE("the line search keeps to its bounds and comes back from where the law cannot follow") {
  LineSearch options;
  options.largest = 2.0;
  CHECK(search_line(options, 1.0, [](double rho) { return 1.0 - 0.1 * rho; }) == 2.0);
  const double rho = search_line(options, 1.0, [](double at) -> double {
    if (at > 0.6) throw Error("integration-failure", "too far");
    return 1.0 - 2.0 * at;
  });
  CHECK(rho == exactly(0.5));
  CHECK_THROWS_WITH(search_line(options, 1.0, [](double) -> double { throw Error("integration-failure", "nowhere"); }),
                    "nowhere");
}

TEST_CASE("a way that would be about zero is RHO_EXCL, one that would lead back RHO_MIN") {
  const LineSearch options{.max_iterations = 1};
  const auto second_trial = [&](double zero) {
    std::vector<double> trials;
    search_line(options, 1.0, [&](double rho) {
      trials.push_back(rho);
      return 1.0 - rho / zero;
    });
    return trials.at(1);
  };
  CHECK(second_trial(0.004) == options.excluded);
  CHECK(second_trial(0.0095) == options.smallest);
  CHECK(second_trial(-0.2) == options.smallest);
  CHECK(second_trial(0.02) == exactly(0.02));
}

TEST_CASE("MIXTE goes three times as far until work changes sign, and then back along secants or to the middle") {
  LineSearch options{.bracketed = true, .tolerance = 1e-6, .max_iterations = 5, .largest = 100.0};
  std::vector<double> trials;
  search_line(options, 1.0, [&](double rho) {
    trials.push_back(rho);
    return 1.0 - 0.1 * rho;
  });
  REQUIRE(trials.size() == 6);
  CHECK(std::vector<double>(trials.begin(), trials.begin() + 5) == std::vector<double>{1.0, 3.0, 9.0, 27.0, 18.0});
  CHECK(trials[5] == exactly(10.0));  // the sign stays from 27 to 18: the secant counts wherever it lies between
  trials.clear();
  options.max_iterations = 3;
  search_line(options, 0.88, [&](double rho) {
    trials.push_back(rho);
    return 1.0 / (1.0 + rho) - 0.12;
  });
  REQUIRE(trials.size() == 4);
  CHECK(trials[2] == 9.0);
  CHECK(trials[3] == exactly(3.0 + 6.0 * 0.13 / 0.15));  // the secant
  // Where the sign changes back, the secant counts in the half of the last trial alone.
  trials.clear();
  options.max_iterations = 5;
  search_line(options, 1.0, [&](double rho) {
    trials.push_back(rho);
    return rho < 1.0 ? 1.0 : rho < 2.5 ? 0.2 : rho < 2.75 ? 0.4 : -0.1;
  });
  REQUIRE(trials.size() > 4);
  CHECK(trials[2] == exactly(1.0 + 2.0 * 0.2 / 0.3));  // between 1 and 3, on the side of 3
  CHECK(trials[3] == exactly(0.5 * (trials[2] + 3.0)));
  trials.clear();
  options.max_iterations = 3;
  options.largest = 2.0;
  search_line(options, 1.0, [&](double rho) {
    trials.push_back(rho);
    return 1.0 - 0.1 * rho;
  });
  CHECK(trials == std::vector<double>{1.0, 2.0});
}

TEST_CASE(
    "while a line is searched, loads that follow stay as they were: the solution is the same, and the way to it "
    "longer") {
  // A block is drawn by a traction that turns and grows with its upper side.
  const auto solve = [](std::optional<LineSearch> search) {
    Scene scene;
    const Scene::Block block = scene.block("b", {0, 0}, {3, 0.6}, 6, 2, 1000.0, 0.3);
    scene.problem.behaviours =
        std::make_shared<const BehaviourOfCells>(static_cast<std::size_t>(scene.mesh->cell_count()),
                                                 CellBehaviour{Kinematics::green_lagrange, Relation::elastic});
    for (const Component component : {Component::dx, Component::dy}) scene.impose(block.nodes.front(), component, 0.0);
    auto traction = std::make_shared<Load>();
    for (const int cell : block.top) traction->pressures.push_back({cell, -600.0, 0.0, {}, {}});
    scene.problem.followers.push_back({traction, {}});
    NewtonOptions options;
    options.relative_residual = 1e-10;
    options.max_iterations = 60;
    options.line_search = search;
    scene.solve(1, options);
    return std::pair(scene.displacement(block.nodes.back().back(), Component::dy), scene.counters.newton_iterations);
  };
  const auto [lifted, few] = solve(std::nullopt);
  const auto [searched, many] = solve(LineSearch{.tolerance = 1e-6, .max_iterations = 10});
  CHECK(searched == Approx(lifted).epsilon(1e-8));
  CHECK(many > few + 3);
}
