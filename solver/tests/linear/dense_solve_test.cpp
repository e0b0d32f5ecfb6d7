#include "solver/linear/dense_solve.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

Eigen::MatrixXd random_symmetric(int n) {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(generator); });
  return half + half.transpose();
}

}  // namespace

TEST_CASE("Products with a symmetric matrix take its lower triangle, in either precision") {
  for (const int n : {50, 1200}) {
    const Eigen::MatrixXd matrix = 1e-11 * random_symmetric(n);
    const Eigen::VectorXd x = 1e50 * Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
    Eigen::MatrixXd lower = matrix;
    lower.triangularView<Eigen::StrictlyUpper>().setConstant(std::numeric_limits<double>::quiet_NaN());
    const Eigen::VectorXd expected = matrix * x;
    CHECK((symmetric_product(lower, x) - expected).norm() < 1e-13 * expected.norm());
    CHECK((SingleTriangle(lower) * x - expected).norm() < 1e-5 * expected.norm());
    CHECK((SingleTriangle(lower) * Eigen::VectorXd::Zero(n)).norm() == 0.0);
  }
}

TEST_CASE("A triangle fills the other one") {
  const int n = 150;  // more than two tiles
  const Eigen::MatrixXd matrix = random_symmetric(n);
  Eigen::MatrixXd filled = matrix;
  filled.triangularView<Eigen::StrictlyUpper>().setZero();
  fill_upper(filled);
  CHECK(filled == matrix);
  filled.triangularView<Eigen::StrictlyLower>().setZero();
  fill_lower(filled);
  CHECK(filled == matrix);
}

TEST_CASE("Where rows depend on each other, the solution is the one of least size") {
  for (const int n : {60, 2 * large_dense}) {
    // Two unknowns count only together, and so do two others; the right-hand side is one that can be reached.
    Eigen::MatrixXd matrix = random_symmetric(n);
    matrix.col(1) = matrix.col(0);
    matrix.col(7) = -matrix.col(5);
    const Eigen::VectorXd b = matrix * Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
    const Eigen::VectorXd x = solve_dense(matrix, b);
    CHECK((matrix * x - b).norm() < 1e-10 * b.norm());
    CHECK(std::abs(x[0] - x[1]) < 1e-10 * x.norm());
    CHECK(std::abs(x[5] + x[7]) < 1e-10 * x.norm());
  }
}
