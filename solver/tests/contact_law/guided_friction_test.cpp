#include <random>

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/coupled_points.hpp"

using namespace comma::solver;

TEST_CASE("Guided points that the bodies go through close for good, whichever attempt finds the solution") {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int solved = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Coupled bodies(6, 0.8 + 0.8 * any(generator));
    Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(18, 18, [&] { return any(generator); });
    bodies.schur = SchurComplement(identity_rows(18),
                                   [compliance = Eigen::MatrixXd(half * half.transpose())](
                                       Eigen::Ref<Eigen::MatrixXd> columns) { columns = compliance * columns; });
    bodies.problem.free = Eigen::VectorXd::NullaryExpr(18, [&] { return any(generator); });
    for (CondensedPoint& point : bodies.problem.points) point.bilateral = true;
    const CondensedSolution solution = solve_condensed(bodies.schur, bodies.problem, bodies.state);
    if (solution.verdict != CondensedVerdict::solved) continue;
    ++solved;
    CAPTURE(trial);
    for (Eigen::Index p = 0; p < 6; ++p)
      if (bodies.problem.free[3 * p] < 0.0)
        CHECK(bodies.state.statuses[static_cast<std::size_t>(p)] != ContactStatus::open);
  }
  CHECK(solved >= 30);
}
