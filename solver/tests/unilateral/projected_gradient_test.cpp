#include "solver/unilateral/projected_gradient.hpp"

#include <random>

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

/// A random definite compliance and excess, as contact rows of a body would give.
struct Random {
  Eigen::MatrixXd compliance;
  ActiveSetProblem problem;

  Random(int rows, unsigned seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    const auto sample = [&](int m, int n) {
      return Eigen::MatrixXd::NullaryExpr(m, n, [&] { return normal(generator); }).eval();
    };
    const Eigen::MatrixXd root = sample(rows, rows);
    compliance = root * root.transpose() / rows + 0.05 * Eigen::MatrixXd::Identity(rows, rows);
    problem.excess = sample(rows, 1);
    problem.scale = Eigen::VectorXd::Ones(rows);
  }

  ActiveSetSolution by_gradients(const ProjectedGradientOptions& options = {}) const {
    return solve_projected_gradient([&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return compliance * x; },
                                    problem, options);
  }
};

}  // namespace

TEST_CASE("projected gradients meet the complementarity conditions") {
  const int rows = GENERATE(1, 3, 20, 60);
  const auto seed = GENERATE(1u, 2u, 3u);
  CAPTURE(rows, seed);
  const Random random(rows, seed);
  const ActiveSetSolution solution = random.by_gradients();
  REQUIRE(solution.verdict == ActiveSetVerdict::solved);
  const Eigen::VectorXd left = random.problem.excess - random.compliance * solution.multipliers;
  CHECK(solution.multipliers.minCoeff() >= 0.0);
  CHECK(left.maxCoeff() <= gradient_share);
  for (const int row : solution.active) CHECK(std::abs(left[row]) <= gradient_share);
}

TEST_CASE("neither the scaling nor the start changes the multipliers") {
  const Random random(30, 7);
  const Eigen::VectorXd expected = random.by_gradients().multipliers;
  ProjectedGradientOptions options;
  options.scaling = random.compliance.diagonal().cwiseSqrt().cwiseInverse();
  options.start = Eigen::VectorXd::Ones(30);
  CHECK((random.by_gradients(options).multipliers - expected).norm() < 1e-9 * expected.norm());
  for (const double multiple : {1.0, 0.1, 7.0}) {
    options.start = multiple * expected;
    CHECK(random.by_gradients(options).iterations <= 2);
  }
}

TEST_CASE("rows that nothing resists, and too few iterations, are told") {
  Random random(5, 3);
  random.compliance.setZero();
  random.problem.excess.setOnes();
  CHECK(random.by_gradients().verdict == ActiveSetVerdict::contradictory);
  ProjectedGradientOptions options;
  options.max_iterations = 2;
  const ActiveSetSolution short_of = Random(60, 1).by_gradients(options);
  CHECK(short_of.verdict == ActiveSetVerdict::too_many_iterations);
  CHECK(short_of.iterations == 2);
  // What may be left is left where the iterations end before.
  options.tolerance = 10.0;
  const Random other(60, 1);
  const ActiveSetSolution rough = other.by_gradients(options);
  CHECK(rough.verdict == ActiveSetVerdict::solved);
  CHECK(rough.iterations == 2);
  CHECK((other.problem.excess - other.compliance * rough.multipliers).maxCoeff() <= 10.0);
}
