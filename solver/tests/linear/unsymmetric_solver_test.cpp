#include "solver/linear/unsymmetric_solver.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "solver/error.hpp"

using namespace comma::solver;

namespace {

struct Parts {
  SymmetricMatrix symmetric;
  SkewMatrix skew;
};

Parts split(const Eigen::MatrixXd& dense) {
  std::vector<Eigen::Triplet<double>> symmetric, skew;
  for (int column = 0; column < dense.cols(); ++column) {
    for (int row = column; row < dense.rows(); ++row) {
      symmetric.emplace_back(row, column, 0.5 * (dense(row, column) + dense(column, row)));
      if (row > column) skew.emplace_back(row, column, 0.5 * (dense(row, column) - dense(column, row)));
    }
  }
  Parts parts{SymmetricMatrix(dense.rows(), dense.cols()), SkewMatrix(dense.rows(), dense.cols())};
  parts.symmetric.setFromTriplets(symmetric.begin(), symmetric.end());
  parts.skew.setFromTriplets(skew.begin(), skew.end());
  return parts;
}

/// Even integers: their halves, and products with integer solutions, carry no rounding.
Eigen::MatrixXd random_integers(int rows, int columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_int_distribution<int> digit(-9, 9);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return 2.0 * digit(generator); });
}

double solve_error(const UnsymmetricSolver& solver, const Eigen::MatrixXd& dense, const Eigen::MatrixXd& expected) {
  Eigen::MatrixXd x = dense * expected;
  solver.solve(x);
  return (x - expected).lpNorm<Eigen::Infinity>() / expected.lpNorm<Eigen::Infinity>();
}

}  // namespace

TEST_CASE("the unsymmetric solver recovers integer solutions of any matrix, many right-hand sides at once") {
  const int n = GENERATE(1, 2, 7, 60);
  CAPTURE(n);
  const Eigen::MatrixXd dense = random_integers(n, n, 3) + 4.0 * Eigen::MatrixXd::Identity(n, n);
  const Parts parts = split(dense);
  CHECK((Eigen::MatrixXd(full_matrix(parts.symmetric, parts.skew)) - dense).norm() == 0.0);
  UnsymmetricSolver solver({});
  REQUIRE(solver.factorise(parts.symmetric, parts.skew).verdict == FactorVerdict::ok);
  CHECK(solve_error(solver, dense, random_integers(n, 70, 4)) <= 1e-15);
}

TEST_CASE("a skew-symmetric matrix has no diagonal and is solved all the same") {
  Eigen::Matrix2d dense;
  dense << 0, 3, -3, 0;
  const Parts parts = split(dense);
  UnsymmetricSolver solver({});
  REQUIRE(solver.factorise(parts.symmetric, parts.skew).verdict == FactorVerdict::ok);
  Eigen::MatrixXd x = Eigen::Vector2d(6, 3);
  solver.solve(x);
  CHECK(x(0) == -1.0);
  CHECK(x(1) == 2.0);
}

TEST_CASE("rows and columns of sizes far apart are neither singular nor inaccurate") {
  Eigen::MatrixXd dense = random_integers(12, 12, 5) + 40.0 * Eigen::MatrixXd::Identity(12, 12);
  for (int i = 0; i < 12; ++i) {
    dense.row(i) *= std::ldexp(1.0, 8 * i - 40);
    dense.col(i) *= std::ldexp(1.0, 35 - 6 * i);
  }
  const Parts parts = split(dense);
  UnsymmetricSolver solver({});
  const FactorReport report = solver.factorise(parts.symmetric, parts.skew);
  CHECK(report.verdict == FactorVerdict::ok);
  CHECK(report.lost_digits <= 2);
  Eigen::MatrixXd x = dense * Eigen::VectorXd::Ones(12);
  CHECK(solver.solve(x) <= 1e-15);
}

TEST_CASE("a singular unsymmetric matrix is told by the unknown behind its null pivot") {
  // The last unknown is moved by nothing: columns 0 and 2 are alike.
  Eigen::Matrix3d dense;
  dense << 4, 1, 4, -1, 3, -1, 2, 5, 2;
  const Parts parts = split(dense);
  UnsymmetricSolver solver({});
  const FactorReport report = solver.factorise(parts.symmetric, parts.skew);
  REQUIRE(report.verdict == FactorVerdict::singular);
  REQUIRE(report.null_rows.size() == 1);
  CHECK((report.null_rows.front() == 0 || report.null_rows.front() == 2));
  Eigen::MatrixXd x = Eigen::Vector3d::Ones();
  CHECK_THROWS_AS(solver.solve(x), Error);

  SECTION("a column of zeros too") {
    dense.col(1).setZero();
    dense.row(1).setZero();
    dense(2, 2) = 7;
    const Parts zero = split(dense);
    const FactorReport told = solver.factorise(zero.symmetric, zero.skew);
    CHECK(told.verdict == FactorVerdict::singular);
    CHECK(told.null_rows == std::vector<int>{1});
  }
}

TEST_CASE("an unknown that moves nothing but is moved is singular, not a lack of memory") {
  // Its row is the pivot of the first column, so that not even a shifted diagonal is left of its own.
  Eigen::Matrix3d dense;
  dense << 1, 0, 1, 4, 0, 2, 2, 0, 7;
  const Parts parts = split(dense);
  UnsymmetricSolver solver({});
  const FactorReport report = solver.factorise(parts.symmetric, parts.skew);
  CHECK(report.verdict == FactorVerdict::singular);
  CHECK(report.null_rows == std::vector<int>{1});
}

TEST_CASE("unknowns that move others alike are singular where no pivot is left either") {
  Eigen::Matrix4d dense = Eigen::Matrix4d::Zero();
  dense.topLeftCorner<2, 4>() << 1, 2, 2, 1, 4, 8, 8, 3;
  dense(3, 3) = 1;
  const Parts parts = split(dense);
  UnsymmetricSolver solver({});
  const FactorReport report = solver.factorise(parts.symmetric, parts.skew);
  CHECK(report.verdict == FactorVerdict::singular);
  CHECK_FALSE(report.null_rows.empty());
}

TEST_CASE("what an unsymmetric matrix does not resist, its Gram matrix does not either") {
  Eigen::Matrix3d dense;
  dense << 4, 1, 4, -1, 3, -1, 2, 5, 2;
  const Parts parts = split(dense);
  const Eigen::MatrixXd gram =
      Eigen::MatrixXd(gram_matrix(full_matrix(parts.symmetric, parts.skew))).selfadjointView<Eigen::Lower>();
  CHECK((gram - dense.transpose() * dense).norm() == 0.0);
  CHECK((gram * Eigen::Vector3d(1, 0, -1)).norm() == 0.0);
}

TEST_CASE("an unsymmetric matrix with an entry that is no number is refused") {
  Parts parts = split(Eigen::Matrix2d::Identity() + Eigen::Matrix2d::Ones());
  parts.skew.coeffRef(1, 0) = std::numeric_limits<double>::quiet_NaN();
  UnsymmetricSolver solver({});
  CHECK_THROWS_AS(solver.factorise(parts.symmetric, parts.skew), Error);
}

TEST_CASE("large unsymmetric matrices are solved by another method, and told when they are singular") {
  constexpr int n = small_unsymmetric_system + 50;
  SymmetricMatrix symmetric(n, n);
  SkewMatrix skew(n, n);
  for (int i = 0; i < n; ++i) {
    symmetric.insert(i, i) = 4.0;
    if (i + 1 == n) break;
    symmetric.insert(i + 1, i) = -1.0;
    skew.insert(i + 1, i) = 1.0 + i % 3;
  }
  UnsymmetricSolver solver({});
  REQUIRE(solver.factorise(symmetric, skew).verdict == FactorVerdict::ok);
  const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(n, -3.0, 5.0);
  Eigen::MatrixXd x = full_matrix(symmetric, skew) * expected;
  CHECK(solver.solve(x) <= 1e-15);
  CHECK((x - expected).norm() <= 1e-14 * expected.norm());

  symmetric.coeffRef(n / 2, n / 2) = 0.0;
  for (const int column : {n / 2 - 1, n / 2})
    symmetric.coeffRef(column + 1, column) = skew.coeffRef(column + 1, column) = 0.0;
  const FactorReport report = solver.factorise(symmetric, skew);
  REQUIRE(report.verdict == FactorVerdict::singular);
  CHECK(report.null_rows == std::vector{n / 2});
}
