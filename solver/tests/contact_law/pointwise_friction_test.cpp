#include <cstdlib>

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/coupled_points.hpp"

using namespace comma::solver;

namespace {

/// A round patch that turns as it is pressed: some of it sticks.
struct TurningPatch : CoupledSurface {
  static constexpr int edge = 12;
  static constexpr std::array<int, 3> statuses{112, 28, 4};  // open, sliding, sticking

  TurningPatch() : CoupledSurface(edge) {
    for (int p = 0; p < edge * edge; ++p) {
      const double x = (p % edge + 0.5) / edge - 0.5, y = (p / edge + 0.5) / edge - 0.5;
      CondensedPoint& point = problem.points[static_cast<std::size_t>(p)];
      point.law.friction = 0.2;
      problem.free.segment<3>(3 * p) << -0.5 + 4.0 * (x * x + y * y), 0.2 * (0.3 + 2.0 * x * x - y),
          0.2 * (y * y - 2.0 * x);
    }
  }
};

}  // namespace

TEST_CASE("Friction on points that turn as they are pressed settles in a few iterations, whatever the augmentation") {
  for (const double augmentation : {1.0, 10.0, 100.0}) {
    TurningPatch patch;
    for (CondensedPoint& point : patch.problem.points) {
      point.law.augmentation *= augmentation;
      point.law.friction_augmentation *= augmentation;
    }
    const CondensedSolution solution = solve_condensed(patch.schur, patch.problem, patch.state);
    REQUIRE(solution.verdict == CondensedVerdict::solved);
    CHECK(solution.iterations <= 15);
    CHECK(patch.counts() == TurningPatch::statuses);
  }
}

TEST_CASE(
    "Penalties a hundred million times as stiff as the bodies settle as fast, by products as well, and differ by no "
    "more from contact without") {
  TurningPatch rigid;
  REQUIRE(solve_condensed(rigid.schur, rigid.problem, rigid.state).verdict == CondensedVerdict::solved);
  for (const int most_direct_rows : {1000, 0}) {
    TurningPatch patch;
    patch.problem.direct_rows = patch.problem.most_direct_rows = most_direct_rows;
    for (CondensedPoint& point : patch.problem.points) {
      point.stiffness = point.law.augmentation;
      point.law.penalised = point.law.friction_penalised = true;
      point.law.augmentation = point.law.friction_augmentation = 1e8 * point.stiffness;
    }
    const CondensedSolution solution = solve_condensed(patch.schur, patch.problem, patch.state);
    REQUIRE(solution.verdict == CondensedVerdict::solved);
    CHECK(solution.iterations <= 15);
    CHECK(patch.counts() == TurningPatch::statuses);
    CHECK((patch.state.multipliers - rigid.state.multipliers).norm() < 1e-7 * rigid.state.multipliers.norm());
  }
}

TEST_CASE("Statuses that come back while less is left are no cycle") {
  constexpr int count = 9, size = 3 * count;
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::srand(seed);
    const Eigen::MatrixXd factor = Eigen::MatrixXd::Random(size, size);
    const Eigen::MatrixXd compliance =
        factor * factor.transpose() / count + 0.3 * Eigen::MatrixXd::Identity(size, size);
    SchurComplement schur(identity_rows(size),
                          [&compliance](Eigen::Ref<Eigen::MatrixXd> columns) { columns = compliance * columns; });
    Coupled bodies(count, 1.0);
    bodies.problem.free = 3.0 * Eigen::VectorXd::Random(size);
    for (int p = 0; p < count; ++p) bodies.problem.free[3 * p] = -1.0;
    const CondensedSolution solution = solve_condensed(schur, bodies.problem, bodies.state);
    CAPTURE(seed);
    REQUIRE(solution.verdict == CondensedVerdict::solved);
    CHECK(solution.iterations <= 12);
  }
}
