#include "solver/contact/relaxation.hpp"

#include <numeric>

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

/// `count` points of three rows each, all on nodes of their own, coupled by a compliance that is dense and positive definite.
struct Coupled {
  CondensedProblem problem;
  CondensedState state;
  SchurComplement schur;

  Coupled(int count, double friction) : schur(identity(3 * count), compliance(3 * count)) {
    problem.node_count = count;
    problem.components = 3;
    problem.free = Eigen::VectorXd::Zero(3 * count);
    problem.held = Eigen::VectorXd::Zero(3 * count);
    for (int p = 0; p < count; ++p) {
      CondensedPoint point;
      point.first_row = 3 * p;
      point.rows = point.components = 3;
      point.nodes[0] = p;
      point.shape[0] = 1.0;
      point.node_count = 1;
      point.weight = 1.0;
      point.law.friction = friction;
      point.law.augmentation = point.law.friction_augmentation = 1.0;
      problem.points.push_back(point);
      problem.free.segment<3>(3 * p) << -1.0 + 0.3 * p, 0.2 * p, 0.5;
    }
    state.multipliers = Eigen::VectorXd::Zero(3 * count);
    state.statuses.assign(static_cast<std::size_t>(count), ContactStatus::open);
  }

  static RowMatrix identity(int size) {
    RowMatrix rows(size, size);
    rows.setIdentity();
    return rows;
  }

  static SchurComplement::ApplyInverse compliance(int size) {
    Eigen::MatrixXd matrix(size, size);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) matrix(i, j) = (i == j ? 1.0 : 0.0) + 0.3 / (1.0 + std::abs(i - j));
    return [matrix](Eigen::Ref<Eigen::MatrixXd> columns) { columns = matrix * columns; };
  }
};

}  // namespace

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
