#include "solver/contact_law/relaxation.hpp"

#include <numeric>
#include <random>

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/coupled_points.hpp"

using namespace comma::solver;

TEST_CASE("Relaxation finds the statuses that Newton's method settles in") {
  for (const double friction : {0.2, 1.0}) {
    Coupled relaxed(6, friction);
    Eigen::VectorXd jumps;
    REQUIRE(relax_condensed(relaxed.schur, relaxed.problem, relaxed.state, jumps));
    Coupled solved(6, friction);
    const CondensedSolution solution = solve_condensed(solved.schur, solved.problem, solved.state);
    REQUIRE(solution.verdict == CondensedVerdict::solved);
    CHECK(relaxed.state.statuses == solved.state.statuses);
    // Sweeps end when forces change by 1e-7 of the largest.
    CHECK((relaxed.state.multipliers - solved.state.multipliers).norm() < 1e-5 * solved.state.multipliers.norm());
  }
}

TEST_CASE("So it does where points have no friction along one direction, in which they slip all the same") {
  Coupled relaxed(6, 0.2);
  for (CondensedPoint& point : relaxed.problem.points) point.law.dead = Eigen::Vector2d(0.6, 0.8);
  Coupled solved = relaxed;
  Eigen::VectorXd jumps;
  REQUIRE(relax_condensed(relaxed.schur, relaxed.problem, relaxed.state, jumps));
  REQUIRE(solve_condensed(solved.schur, solved.problem, solved.state).verdict == CondensedVerdict::solved);
  CHECK(relaxed.state.statuses == solved.state.statuses);
  CHECK((relaxed.state.multipliers - solved.state.multipliers).norm() < 1e-5 * solved.state.multipliers.norm());
  CHECK(std::abs(jumps.segment<2>(1).dot(Eigen::Vector2d(0.6, 0.8))) > 0.1);
}

TEST_CASE("The condensed solution obeys the law of Coulomb") {
  Coupled scene(6, 0.4);
  const CondensedSolution solution = solve_condensed(scene.schur, scene.problem, scene.state);
  REQUIRE(solution.verdict == CondensedVerdict::solved);
  std::vector<int> rows(18);
  std::iota(rows.begin(), rows.end(), 0);
  scene.schur.require(rows);
  Eigen::VectorXd jumps = scene.problem.free;
  for (int row = 0; row < jumps.size(); ++row) jumps += solution.forces[row] * scene.schur.column(row);
  for (int p = 0; p < 6; ++p) {
    const Eigen::Vector3d force = solution.forces.segment<3>(3 * p);
    const Eigen::Vector3d jump = jumps.segment<3>(3 * p);
    CHECK(force[0] >= -1e-12);
    CHECK(jump[0] >= -1e-12);
    CHECK(std::abs(force[0] * jump[0]) < 1e-12);
    CHECK(force.tail<2>().norm() <= 0.4 * force[0] + 1e-10);
    // Sliding goes against the shear, whose size is then the limit.
    if (jump.tail<2>().norm() > 1e-10 && force[0] > 0.0)
      CHECK(force.tail<2>().dot(jump.tail<2>()) == Approx(-0.4 * force[0] * jump.tail<2>().norm()).epsilon(1e-8));
  }
}

TEST_CASE("Points that stuck slide where displacements are imposed that leave their slip no freedom") {
  constexpr int count = 4;
  Coupled scene(count, 0.25);
  Eigen::VectorXd normal = Eigen::VectorXd::Zero(3 * count);
  for (int p = 0; p < count; ++p) {
    normal[3 * p] = 1.0;
    scene.problem.free.segment<3>(3 * p) << -1.0, 0.3, 0.4;
  }
  SchurComplement schur(identity_rows(3 * count),
                        [&](Eigen::Ref<Eigen::MatrixXd> columns) { columns = (normal.asDiagonal() * columns).eval(); });
  scene.state.statuses.assign(count, ContactStatus::sticking);
  const CondensedSolution solution = solve_condensed(schur, scene.problem, scene.state);
  REQUIRE(solution.verdict == CondensedVerdict::solved);
  for (int p = 0; p < count; ++p)
    CHECK((solution.forces.segment<3>(3 * p) - Eigen::Vector3d(1.0, -0.15, -0.2)).norm() < 1e-12);
}

TEST_CASE("Friction grows from none where a status does not settle") {
  // Normal forces move the points sideways, and friction is stronger than what causes it: cycles, for Newton's method
  // and sweeps alike.
  constexpr int count = 30, size = 2 * count;
  std::minstd_rand numbers(7);
  std::uniform_real_distribution<double> between(-1.0, 1.0);
  int solved = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Eigen::MatrixXd factor(size, size);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) factor(i, j) = between(numbers);
    const Eigen::MatrixXd matrix = factor * factor.transpose() / size + 0.002 * Eigen::MatrixXd::Identity(size, size);
    SchurComplement schur(identity_rows(size),
                          [matrix](Eigen::Ref<Eigen::MatrixXd> columns) { columns = matrix * columns; });
    CondensedProblem problem;
    problem.node_count = count;
    problem.components = 2;
    problem.free.resize(size);
    problem.held = Eigen::VectorXd::Zero(size);
    for (int p = 0; p < count; ++p) {
      problem.points.push_back(point_on_node(p, 2, 3.0));
      problem.free.segment<2>(2 * p) << between(numbers) - 0.7, between(numbers);
    }
    CondensedState state;
    state.multipliers = Eigen::VectorXd::Zero(size);
    state.statuses.assign(count, ContactStatus::open);
    solved += solve_condensed(schur, problem, state).verdict == CondensedVerdict::solved;
  }
  CHECK(solved == 40);
}
