#include "solver/unilateral/active_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

/// min 1/2 u^T K u - f^T u subject to A u <= b, K dense.
struct DenseProblem {
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd force;
  Eigen::MatrixXd rows;
  Eigen::VectorXd bounds;
};

struct Outcome {
  ActiveSetSolution solution;
  Eigen::VectorXd u;
  long columns_solved = 0;
};

Outcome solve(const DenseProblem& problem, std::vector<int> guess = {}, const Eigen::VectorXd& beginning = {}) {
  Outcome outcome;
  const Eigen::LDLT<Eigen::MatrixXd> factor(problem.stiffness);
  SchurComplement schur(problem.rows.sparseView(), [&](Eigen::Ref<Eigen::MatrixXd> rhs) {
    outcome.columns_solved += rhs.cols();
    rhs = factor.solve(rhs).eval();
  });
  const Eigen::VectorXd free = factor.solve(problem.force);
  ActiveSetProblem active_set;
  active_set.excess = problem.rows * free - problem.bounds;
  active_set.scale = problem.bounds.cwiseAbs() + problem.rows.cwiseAbs() * free.cwiseAbs();
  active_set.scale = active_set.scale.cwiseMax(1e-30);
  active_set.guess = std::move(guess);
  active_set.beginning = beginning;
  outcome.solution = solve_active_set(schur, active_set);
  outcome.u = free - factor.solve(problem.rows.transpose() * outcome.solution.multipliers);
  return outcome;
}

double energy(const DenseProblem& problem, const Eigen::VectorXd& u) {
  return 0.5 * u.dot(problem.stiffness * u) - problem.force.dot(u);
}

/// The least energy over all active sets whose equality solution is admissible: the minimum, by enumeration.
double brute_force_minimum(const DenseProblem& problem) {
  const int m = static_cast<int>(problem.rows.rows());
  const int n = static_cast<int>(problem.rows.cols());
  double best = std::numeric_limits<double>::infinity();
  for (int set = 0; set < (1 << m); ++set) {
    std::vector<int> active;
    for (int i = 0; i < m; ++i)
      if (set >> i & 1) active.push_back(i);
    const int k = static_cast<int>(active.size());
    if (k > n) continue;
    Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(n + k, n + k);
    Eigen::VectorXd rhs(n + k);
    kkt.topLeftCorner(n, n) = problem.stiffness;
    rhs.head(n) = problem.force;
    for (int i = 0; i < k; ++i) {
      kkt.block(n + i, 0, 1, n) = problem.rows.row(active[i]);
      kkt.block(0, n + i, n, 1) = problem.rows.row(active[i]).transpose();
      rhs[n + i] = problem.bounds[active[i]];
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> factor(kkt);
    if (!factor.isInvertible()) continue;
    const Eigen::VectorXd u = factor.solve(rhs).head(n);
    if (((problem.rows * u - problem.bounds).array() > 1e-9).any()) continue;
    best = std::min(best, energy(problem, u));
  }
  return best;
}

DenseProblem random_problem(std::mt19937& generator, int n, int m) {
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(generator); };
  DenseProblem problem;
  const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(n, n, draw);
  problem.stiffness = half * half.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
  problem.force = 5.0 * Eigen::VectorXd::NullaryExpr(n, draw);
  problem.rows = Eigen::MatrixXd::NullaryExpr(m, n, draw);
  problem.bounds = Eigen::VectorXd::NullaryExpr(m, [&] { return std::abs(normal(generator)); });
  return problem;
}

void check_kkt(const DenseProblem& problem, const Outcome& outcome) {
  REQUIRE(outcome.solution.verdict == ActiveSetVerdict::solved);
  const Eigen::VectorXd& multipliers = outcome.solution.multipliers;
  const Eigen::VectorXd slack = problem.bounds - problem.rows * outcome.u;
  const double size = problem.rows.norm() * outcome.u.norm() + problem.bounds.norm();
  CHECK(multipliers.minCoeff() >= 0.0);
  // K^-1 loses the condition number (up to 1e5 here) of the 16 digits.
  CHECK(slack.minCoeff() >= -1e-10 * size);
  CHECK(std::abs(multipliers.dot(slack)) <= 1e-9 * (1.0 + multipliers.norm() * size));
  const Eigen::VectorXd equilibrium =
      problem.stiffness * outcome.u - problem.force + problem.rows.transpose() * multipliers;
  CHECK(equilibrium.norm() <= 1e-9 * (problem.force.norm() + problem.stiffness.norm() * outcome.u.norm()));
}

}  // namespace

TEST_CASE("The active set finds the minimum that enumeration finds") {
  std::mt19937 generator(237);
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 2 + trial % 7;
    const int m = 1 + trial % 10;
    const DenseProblem problem = random_problem(generator, n, m);
    const Outcome outcome = solve(problem);
    check_kkt(problem, outcome);
    const double minimum = brute_force_minimum(problem);
    CHECK(energy(problem, outcome.u) == Approx(minimum).epsilon(1e-8).margin(1e-9));
  }
}

TEST_CASE("A warm start from any guess ends at the same place, and from the right one at once") {
  std::mt19937 generator(11);
  for (int trial = 0; trial < 50; ++trial) {
    const DenseProblem problem = random_problem(generator, 8, 12);
    const Outcome cold = solve(problem);
    std::vector<int> wrong;
    for (int i = 0; i < 12; ++i)
      if (generator() % 2) wrong.push_back(i);
    const Outcome warm = solve(problem, wrong);
    CHECK((warm.u - cold.u).norm() <= 1e-8 * (1.0 + cold.u.norm()));
    CHECK(solve(problem, cold.solution.active).solution.iterations == 0);
  }
}

TEST_CASE("Conditions written twice, scaled or combined change nothing") {
  std::mt19937 generator(5);
  for (int trial = 0; trial < 50; ++trial) {
    const DenseProblem problem = random_problem(generator, 6, 5);
    DenseProblem doubled = problem;
    doubled.rows.resize(15, 6);
    doubled.bounds.resize(15);
    for (int i = 0; i < 5; ++i) {
      doubled.rows.row(i) = problem.rows.row(i);
      doubled.rows.row(5 + i) = 3.0 * problem.rows.row(i);
      doubled.rows.row(10 + i) = problem.rows.row(i) + problem.rows.row((i + 1) % 5);
      doubled.bounds[i] = problem.bounds[i];
      doubled.bounds[5 + i] = 3.0 * problem.bounds[i];
      doubled.bounds[10 + i] = problem.bounds[i] + problem.bounds[(i + 1) % 5];
    }
    const Outcome outcome = solve(doubled);
    check_kkt(doubled, outcome);
    CHECK((outcome.u - solve(problem).u).norm() <= 1e-8 * (1.0 + outcome.u.norm()));
  }
}

TEST_CASE("More rows than unknowns at one corner") {
  // Every row is tight at u = (1, 1), which the force pushes into: a degenerate vertex.
  DenseProblem problem;
  problem.stiffness = Eigen::MatrixXd::Identity(2, 2);
  problem.force = Eigen::Vector2d(10.0, 10.0);
  problem.rows.resize(9, 2);
  problem.bounds.resize(9);
  for (int i = 0; i < 9; ++i) {
    const double angle = 0.5 * M_PI * i / 8.0;
    problem.rows.row(i) << std::cos(angle), std::sin(angle);
    problem.bounds[i] = std::cos(angle) + std::sin(angle);
  }
  const Outcome outcome = solve(problem);
  check_kkt(problem, outcome);
  CHECK(outcome.u[0] == Approx(1.0).epsilon(1e-12));
  CHECK(outcome.u[1] == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("Conditions that cannot hold together are named") {
  DenseProblem problem;
  problem.stiffness = Eigen::MatrixXd::Identity(3, 3);
  problem.force = Eigen::Vector3d(1.0, 0.0, 0.0);
  problem.rows.resize(3, 3);
  problem.rows << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0;  // u_x <= -1 and u_x >= 2
  problem.bounds = Eigen::Vector3d(1.0, -1.0, -2.0);
  const ActiveSetSolution solution = solve(problem).solution;
  REQUIRE(solution.verdict == ActiveSetVerdict::contradictory);
  std::vector<int> rows = solution.contradiction;
  std::sort(rows.begin(), rows.end());
  CHECK(rows == std::vector<int>{1, 2});
}

TEST_CASE("Three conditions that pairwise hold but not together") {
  DenseProblem problem;
  problem.stiffness = Eigen::MatrixXd::Identity(2, 2);
  problem.force = Eigen::Vector2d::Zero();
  problem.rows.resize(3, 2);
  problem.rows << -1.0, 0.0, 0.0, -1.0, 1.0, 1.0;  // x >= 1, y >= 1, x + y <= 1
  problem.bounds = Eigen::Vector3d(-1.0, -1.0, 1.0);
  const ActiveSetSolution solution = solve(problem).solution;
  REQUIRE(solution.verdict == ActiveSetVerdict::contradictory);
  CHECK(solution.contradiction.size() == 3);
}

TEST_CASE("A row that the free solution holds stays open unless it is violated more than at the beginning") {
  // The ends of a stiff lever on two springs at 2/5 and 3/5 of its length, above bounds of 0.1 and -0.05.
  const Eigen::Vector2d near(0.6, 0.4), far(0.4, 0.6);
  DenseProblem lever;
  lever.stiffness = near * near.transpose() + far * far.transpose();
  lever.rows = -Eigen::Matrix2d::Identity();
  lever.bounds = Eigen::Vector2d(-0.1, 0.05);
  const auto ends = [&](const Eigen::Vector2d& force, const Eigen::VectorXd& beginning) {
    lever.force = force;
    return solve(lever, {}, beginning).u;
  };
  const Eigen::Vector2d at_bounds(0.1, -0.05);
  const Eigen::Vector2d lifts(0.006, -0.006), lifts_less(0.002, -0.004);  // to (0.15, -0.15), (0.074, -0.076)
  CHECK((ends(lifts, {}) - at_bounds).norm() < 1e-12);
  CHECK((ends(lifts, Eigen::Vector2d(0.1, -0.05)) - Eigen::Vector2d(0.15 - 12.0 / 130.0, -0.05)).norm() < 1e-12);
  CHECK((ends(lifts, Eigen::Vector2d(0.04, -0.05)) - at_bounds).norm() < 1e-12);
  CHECK((ends(lifts_less, Eigen::Vector2d(0.1, -0.05)) - at_bounds).norm() < 1e-12);
}

TEST_CASE("Only rows that get active cost a solve, and only once") {
  // A chain of unit springs pushed at its end against a stop: one of many conditions acts.
  const int n = 20;
  DenseProblem problem;
  problem.stiffness = Eigen::MatrixXd::Identity(n, n);
  problem.force = Eigen::VectorXd::Zero(n);
  problem.force[n - 1] = 2.0;
  problem.rows = Eigen::MatrixXd::Identity(n, n);
  problem.bounds = Eigen::VectorXd::Ones(n);
  const Outcome outcome = solve(problem);
  CHECK(outcome.solution.active == std::vector<int>{n - 1});
  CHECK(outcome.solution.multipliers[n - 1] == exactly(1.0));
  CHECK(outcome.columns_solved == 1);
}
