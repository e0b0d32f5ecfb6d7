#include "solver/unilateral/status_iteration.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

struct Held {
  ActiveSetSolution solution;
  Eigen::VectorXd u;
};

/// u with K u = f - A^T lambda, A u <= b.
Held hold(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& force, const Eigen::MatrixXd& rows,
          const Eigen::VectorXd& bounds, std::vector<int> guess) {
  const Eigen::PartialPivLU<Eigen::MatrixXd> factor(stiffness);
  SchurComplement schur(rows.sparseView(), [&](Eigen::Ref<Eigen::MatrixXd> rhs) { rhs = factor.solve(rhs).eval(); });
  const Eigen::VectorXd free = factor.solve(force);
  ActiveSetProblem problem;
  problem.excess = rows * free - bounds;
  problem.scale = Eigen::VectorXd::Ones(bounds.size());
  problem.guess = std::move(guess);
  Held held;
  held.solution = solve_by_statuses(schur, problem);
  held.u = free - factor.solve(rows.transpose() * held.solution.multipliers);
  return held;
}

}  // namespace

TEST_CASE("A body that would buckle stays against the stops that hold it") {
  // Alone the first unknown pushes itself away: u = -1 without a stop, which is no place of rest.
  const Eigen::MatrixXd stiffness = Eigen::Vector3d(-1.0, 2.0, 4.0).asDiagonal();
  const Eigen::Vector3d force(1.0, 2.0, -4.0);
  const Eigen::MatrixXd stops = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d bounds(0.5, 0.25, 0.0);
  const Held held = hold(stiffness, force, stops, bounds, {0});
  REQUIRE(held.solution.verdict == ActiveSetVerdict::solved);
  REQUIRE(held.solution.active == std::vector<int>({0, 1}));
  REQUIRE((held.u - Eigen::Vector3d(0.5, 0.25, -1.0)).norm() < 1e-14);
  REQUIRE((held.solution.multipliers - Eigen::Vector3d(1.5, 1.5, 0.0)).norm() < 1e-14);
}

TEST_CASE("Where the stiffness is positive the statuses settle where the active set does, from any guess") {
  Eigen::MatrixXd stiffness(4, 4);
  stiffness << 4, -1, 0, 0, -1, 4, -1, 0, 0, -1, 4, -1, 0, 0, -1, 4;
  const Eigen::Vector4d force(3.0, -1.0, 2.0, 1.0);
  const Eigen::Vector4d bounds(0.1, 0.2, 0.1, 0.5);
  const Eigen::MatrixXd rows = Eigen::Matrix4d::Identity();
  const Held reference = hold(stiffness, force, rows, bounds, {});
  REQUIRE(reference.solution.verdict == ActiveSetVerdict::solved);
  REQUIRE((reference.u - bounds).maxCoeff() < 1e-12);
  REQUIRE(reference.solution.multipliers.dot(reference.u - bounds) == Approx(0.0).margin(1e-12));
  for (int set = 0; set < 16; ++set) {
    std::vector<int> guess;
    for (int row = 0; row < 4; ++row)
      if (set >> row & 1) guess.push_back(row);
    const Held held = hold(stiffness, force, rows, bounds, guess);
    REQUIRE(held.solution.verdict == ActiveSetVerdict::solved);
    REQUIRE((held.u - reference.u).norm() < 1e-13);
  }
}
