#include "solver/contact_law/shared_friction.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/coupled_points.hpp"

using namespace comma::solver;

namespace {

bool by_shares(const CondensedProblem& problem) {
  return std::ranges::any_of(problem.points,
                             [](const CondensedPoint& point) { return point.law.share_pressure > 0.0; });
}

/// A point between two nodes.
CondensedProblem between_nodes() {
  CondensedPoint point;
  point.first_row = 0;
  point.rows = point.components = 2;
  point.nodes = {0, 1};
  point.shape = {0.5, 0.5};
  point.node_count = 2;
  point.weight = 1.0;
  point.law.friction = 0.3;
  point.share_augmentation = 10.0;
  CondensedProblem problem;
  problem.points = {point};
  problem.node_count = problem.components = 2;
  problem.free = problem.held = Eigen::VectorXd::Zero(2);
  return problem;
}

}  // namespace

TEST_CASE("A solution by shears says that it is one where none by shares of the limit is found") {
  const CondensedProblem problem = between_nodes();
  for (const bool finds_shares : {true, false}) {
    const auto method = [&](const CondensedProblem& each, CondensedState& state) {
      CondensedSolution solution;
      if (by_shares(each) && !finds_shares) solution.verdict = CondensedVerdict::too_many_iterations;
      state.multipliers = Eigen::Vector4d(2.0, 0.1, 2.0, 0.1);
      state.statuses = {ContactStatus::sticking};
      return solution;
    };
    CondensedState state{.multipliers = Eigen::Vector4d(1.0, 0.0, 1.0, 0.0), .statuses = {ContactStatus::sticking}};
    const CondensedSolution solution = solve_shared_friction(problem, state, {method, method, method, method, method});
    REQUIRE(solution.verdict == CondensedVerdict::solved);
    CHECK(solution.by_shears == !finds_shares);
  }
}

TEST_CASE("Shares of friction are weighed by the pressures of their own surface") {
  CondensedProblem problem = between_nodes();
  problem.points.push_back(problem.points.front());
  problem.points.back().first_row = 2;
  problem.points.back().nodes = {2, 3};
  problem.node_count = 4;
  problem.free = problem.held = Eigen::VectorXd::Zero(4);
  CondensedState state{.multipliers = Eigen::VectorXd::Zero(8),
                       .statuses = {ContactStatus::sticking, ContactStatus::sticking}};
  std::vector<double> weighed_by;
  const auto method = [&](const CondensedProblem& each, CondensedState& solved) {
    if (by_shares(each)) weighed_by = {each.points[0].law.share_pressure, each.points[1].law.share_pressure};
    for (const Eigen::Index node : {0, 1, 2, 3})
      solved.multipliers[2 * node] = node < 2 ? 2.0 + static_cast<double>(node) : 5.0e6;
    return CondensedSolution{};
  };
  REQUIRE(solve_shared_friction(problem, state, {method, method, method, method, method}).verdict ==
          CondensedVerdict::solved);
  CHECK(weighed_by == std::vector<double>{3.0, 5.0e6});
}

TEST_CASE("A solution with penalties is gone on from by its forces, not from gaps that no force has closed") {
  // Bodies overlap by 1 before they push; penalties are a thousand times as stiff as they are.
  Coupled bodies(8, 0.5);
  for (std::size_t p = 0; p < bodies.problem.points.size(); ++p) {
    CondensedPoint& point = bodies.problem.points[p];
    point.law.penalised = point.law.friction_penalised = true;
    point.law.augmentation = 1000.0;
    point.share_augmentation = 2000.0;
    bodies.problem.free.segment<3>(3 * static_cast<Eigen::Index>(p)) << -1.0, 0.01, -0.02;
  }
  bodies.state.statuses.assign(8, ContactStatus::sticking);
  const CondensedSolution solution = solve_condensed(bodies.schur, bodies.problem, bodies.state);
  REQUIRE(solution.verdict == CondensedVerdict::solved);
  CHECK_FALSE(solution.by_shears);
  CHECK(std::ranges::count(bodies.state.statuses, ContactStatus::sticking) == 8);
  CHECK(solution.iterations <= 12);
}

TEST_CASE("Shares of friction are found in a few iterations, and are the same whatever they are found from") {
  constexpr int edge = 16;
  CoupledSurface surface(edge);
  surface.share_multipliers(edge);
  for (CondensedPoint& point : surface.problem.points) point.share_augmentation = 1.0;
  REQUIRE(solve_condensed(surface.schur, surface.problem, surface.state).verdict == CondensedVerdict::solved);
  for (const int count : surface.counts()) CHECK(count > 0);

  const CondensedState before = surface.state;
  surface.problem.free *= 1.2;
  CondensedState from_before = before, expected = before;
  const CondensedSolution slower = solve_condensed(surface.schur, surface.problem, from_before);
  surface.problem.expected = 1.2 * before.multipliers;
  const CondensedSolution solution = solve_condensed(surface.schur, surface.problem, expected);
  REQUIRE(slower.verdict == CondensedVerdict::solved);
  REQUIRE(solution.verdict == CondensedVerdict::solved);
  CHECK_FALSE(solution.by_shears);
  CHECK(expected.statuses == from_before.statuses);
  CHECK((solution.forces - slower.forces).norm() < 1e-8 * solution.forces.norm());
  CHECK(solution.iterations <= 5);
  CHECK(slower.iterations <= 9);
}
