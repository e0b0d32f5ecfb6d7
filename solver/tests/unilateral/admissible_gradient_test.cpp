#include "solver/unilateral/admissible_gradient.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

/// Two rows that push each other back: both are violated without forces, and only the first pushes in the end.
struct Coupled {
  Eigen::Matrix2d compliance{{2.0, 1.0}, {1.0, 1.0}};
  ActiveSetProblem problem;

  Coupled() {
    problem.excess = Eigen::Vector2d(4.0, 1.0);
    problem.scale = Eigen::Vector2d::Ones();
  }

  std::optional<ActiveSetSolution> solved(const AdmissibleGradientOptions& options) const {
    return solve_admissible_gradient([&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return compliance * x; },
                                     problem, options);
  }
};

}  // namespace

TEST_CASE("admissible gradients end at the multipliers, whichever way steps are taken") {
  const bool stays = GENERATE(true, false);
  const auto solution = Coupled().solved({.tolerance = 1e-12, .stays_admissible = stays});
  REQUIRE(solution);
  CHECK(solution->multipliers.isApprox(Eigen::Vector2d(2.0, 0.0)));
  CHECK(solution->active == std::vector{0});
}

TEST_CASE("admissible gradients stop where no row is violated by more than the tolerance") {
  // The first step, along the excess (4, 1), has the length 17 / 41.
  const double length = 17.0 / 41.0;
  const Eigen::Vector2d first = length * Eigen::Vector2d(4.0, 1.0);
  const Eigen::Vector2d left = Eigen::Vector2d(4.0, 1.0) - Coupled().compliance * first;
  const auto solution = Coupled().solved({.tolerance = left.cwiseAbs().maxCoeff() + 1e-12});
  REQUIRE(solution);
  CHECK(solution->iterations == 1);
  CHECK(solution->multipliers.isApprox(first));
}

TEST_CASE("admissible gradients keep a start that is good enough") {
  const Eigen::Vector2d start(1.9, 0.0);
  const auto solution = Coupled().solved({.tolerance = 0.3, .start = start});
  REQUIRE(solution);
  CHECK(solution->iterations == 0);
  CHECK(solution->multipliers == start);
}

TEST_CASE("admissible gradients give up where nothing resists, and where they may not go on") {
  Coupled loose;
  loose.compliance.setZero();
  CHECK_FALSE(loose.solved({}));
  CHECK_FALSE(Coupled().solved({.tolerance = 1e-12, .max_iterations = 1}));
}
