#include "solver/linear/linear_solver.hpp"

#include <numeric>
#include <random>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/linear/equilibration.hpp"

using namespace comma::solver;

namespace linear_solver_test {

const std::vector<LinearMethod> every_method = {LinearMethod::mumps, LinearMethod::cholmod, LinearMethod::eigen_ldlt};

SymmetricMatrix lower_triangle(const Eigen::MatrixXd& dense) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < dense.cols(); ++column) {
    for (int row = column; row < dense.rows(); ++row) {
      if (row == column || dense(row, column) != 0.0) entries.emplace_back(row, column, dense(row, column));
    }
  }
  SymmetricMatrix matrix(dense.rows(), dense.cols());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Small integers, so that right-hand sides of integer solutions carry no rounding.
Eigen::MatrixXd random_integers(int rows, int columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_int_distribution<int> digit(-9, 9);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return static_cast<double>(digit(generator)); });
}

/// Springs in a row between walls: node i carries k_i + k_(i+1).
Eigen::MatrixXd chain(const std::vector<double>& springs) {
  const int n = static_cast<int>(springs.size()) - 1;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i <= n; ++i) {
    if (i > 0) stiffness(i - 1, i - 1) += springs[i];
    if (i < n) stiffness(i, i) += springs[i];
    if (i > 0 && i < n) stiffness(i, i - 1) = stiffness(i - 1, i) = -springs[i];
  }
  return stiffness;
}

double solve_error(LinearSolver& solver, const Eigen::MatrixXd& dense, const Eigen::MatrixXd& expected) {
  Eigen::MatrixXd x = dense * expected;
  solver.solve(x);
  return (x - expected).lpNorm<Eigen::Infinity>() / expected.lpNorm<Eigen::Infinity>();
}

TEST_CASE("every solver recovers the integer solutions of positive definite systems, many right-hand sides at once") {
  const auto method = GENERATE(from_range(every_method));
  const int n = GENERATE(1, 2, 7, 60);
  CAPTURE(name_of(method), n);
  const Eigen::MatrixXd root = random_integers(n, n, 1);
  const Eigen::MatrixXd dense = root * root.transpose() + Eigen::MatrixXd::Identity(n, n);
  auto solver = make_linear_solver(method, {});
  solver->analyse(lower_triangle(dense));
  const FactorReport report = solver->factorise(lower_triangle(dense));
  CHECK(report.verdict == FactorVerdict::ok);
  CHECK(report.null_rows.empty());
  // More columns than a block of refinement holds.
  CHECK(solve_error(*solver, dense, random_integers(n, 70, 2)) <= 1e-15);
}

TEST_CASE("one analysis serves many matrices of a pattern, and another pattern is analysed again") {
  const auto method = GENERATE(from_range(every_method));
  CAPTURE(name_of(method));
  auto solver = make_linear_solver(method, {});
  solver->analyse(lower_triangle(chain({1, 1, 1, 1})));
  for (const double stiffness : {1.0, 3.0, 1024.0}) {
    const Eigen::MatrixXd dense = chain({stiffness, 2, 5, 1});
    REQUIRE(solver->factorise(lower_triangle(dense)).verdict == FactorVerdict::ok);
    CHECK(solve_error(*solver, dense, random_integers(3, 2, 3)) <= 1e-15);
  }
  const Eigen::MatrixXd longer = chain({1, 2, 3, 4, 5, 6});
  REQUIRE(solver->factorise(lower_triangle(longer)).verdict == FactorVerdict::ok);
  CHECK(solve_error(*solver, longer, random_integers(5, 2, 4)) <= 1e-15);
}

TEST_CASE("indefinite systems are solved and named indefinite") {
  const auto method = GENERATE(from_range(every_method));
  CAPTURE(name_of(method));
  const int n = 40;
  Eigen::MatrixXd dense = random_integers(n, n, 5);
  dense = (dense + dense.transpose()).eval();
  for (int i = 0; i < n; ++i) dense(i, i) = (i % 2 == 0 ? 400.0 : -400.0);
  auto solver = make_linear_solver(method, {});
  solver->analyse(lower_triangle(dense));
  CHECK(solver->factorise(lower_triangle(dense)).verdict == FactorVerdict::indefinite);
  CHECK(solve_error(*solver, dense, random_integers(n, 3, 6)) <= 1e-15);
}

TEST_CASE("a saddle point with a zero diagonal needs MUMPS, which is therefore chosen") {
  // Two springs whose ends a multiplier ties together: K = diag(2, 3), u1 - u2 = c.
  Eigen::Matrix3d dense;
  dense << 2, 0, 1, 0, 3, -1, 1, -1, 0;
  CHECK(choose_method(lower_triangle(dense)) == LinearMethod::mumps);
  auto solver = make_linear_solver(LinearMethod::mumps, {});
  solver->analyse(lower_triangle(dense));
  CHECK(solver->factorise(lower_triangle(dense)).verdict == FactorVerdict::indefinite);
  CHECK(solve_error(*solver, dense, random_integers(3, 3, 7)) <= 1e-15);
}

TEST_CASE("a pressure that only ties others is no sign of singularity, whatever their stiffness") {
  // A displacement, a pressure and a change of volume: the pressure has no stiffness of its own.
  const double side = 0x1p-6, volume = 0x1p-13;
  for (const double stiffness : {0x1p-10, 1.0, 0x1p37}) {
    CAPTURE(stiffness);
    Eigen::Matrix3d dense;
    dense << stiffness, side, 0, side, 0, -volume, 0, -volume, stiffness * volume;
    auto solver = make_linear_solver(LinearMethod::mumps, {});
    solver->analyse(lower_triangle(dense));
    CHECK(solver->factorise(lower_triangle(dense)).verdict == FactorVerdict::indefinite);
    const Eigen::VectorXd maxima =
        row_maxima(scaled(lower_triangle(dense), equilibration_factors(lower_triangle(dense))));
    CHECK(maxima.minCoeff() >= 0.5);
    CHECK(maxima.maxCoeff() <= 2.0);
  }
}

TEST_CASE("without interchanges a saddle point may have no pivot where MUMPS has two") {
  // The second pivot is all but lost to the first, and the third row, which would have made one with it, comes too
  // late.
  const double left = std::ldexp(1.0, -32);
  const Eigen::Matrix4d dense{
      {1.0, 1.0, 0.0, 0.0}, {1.0, 1.0 + left, 0.01, 0.0}, {0.0, 0.01, 0.0, 1.0}, {0.0, 0.0, 1.0, 1.0}};
  REQUIRE(choose_method(lower_triangle(dense)) == LinearMethod::mumps);
  for (const LinearMethod method : {LinearMethod::eigen_ldlt, LinearMethod::mumps}) {
    CAPTURE(name_of(method));
    auto solver = make_linear_solver(method, {});
    solver->analyse(lower_triangle(dense));
    CHECK(solver->factorise(lower_triangle(dense)).verdict ==
          (method == LinearMethod::mumps ? FactorVerdict::indefinite : FactorVerdict::singular));
  }
}

TEST_CASE("refinement reaches full accuracy on Hilbert matrices up to a condition of 1e15") {
  const auto method = GENERATE(from_range(every_method));
  const int n = GENERATE(4, 8, 11);  // conditions 1.6e4, 1.5e10, 5.2e14
  CAPTURE(name_of(method), n);
  // The entries of the Hilbert matrix times lcm(1 .. 2n-1) are integers: rows times a vector of ones have no rounding.
  double multiple = 1.0;
  for (int i = 1; i <= 2 * n - 1; ++i) multiple = std::lcm(static_cast<long>(multiple), static_cast<long>(i));
  const Eigen::MatrixXd hilbert =
      Eigen::MatrixXd::NullaryExpr(n, n, [&](auto i, auto j) { return multiple / (i + j + 1.0); });
  LinearOptions options;
  options.singular_digits = -1;
  auto solver = make_linear_solver(method, options);
  solver->analyse(lower_triangle(hilbert));
  solver->factorise(lower_triangle(hilbert));
  CHECK(solve_error(*solver, hilbert, Eigen::VectorXd::Ones(n)) <= 1e-15);
}

TEST_CASE("bodies of very different stiffness do not hide each other") {
  const auto method = GENERATE(from_range(every_method));
  CAPTURE(name_of(method));
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(6, 6);
  dense.topLeftCorner(3, 3) = chain({1e-6, 2e-6, 1e-6, 1e-6});
  dense.bottomRightCorner(3, 3) = chain({1e16, 2e16, 1e16, 1e16});
  auto solver = make_linear_solver(method, {});
  solver->analyse(lower_triangle(dense));
  const FactorReport report = solver->factorise(lower_triangle(dense));
  CHECK(report.verdict == FactorVerdict::ok);
  CHECK(report.lost_digits == 0);
}

TEST_CASE("a chain that nothing holds is singular, and one of its own rows is named") {
  const auto method = GENERATE(from_range(every_method));
  // Halves and thirds: cancellation is exact for the first, leaves rounding for the second.
  const double spring = GENERATE(1.0, 1.0 / 3.0, 2e16 / 3.0);
  CAPTURE(name_of(method), spring);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(9, 9);
  dense.topLeftCorner(4, 4) = chain({spring, spring, spring, spring, spring});
  dense.bottomRightCorner(5, 5) = chain({0.0, spring, spring * 1.1, spring, spring, 0.0});
  auto solver = make_linear_solver(method, {});
  solver->analyse(lower_triangle(dense));
  const FactorReport report = solver->factorise(lower_triangle(dense));
  REQUIRE(report.verdict == FactorVerdict::singular);
  REQUIRE(report.null_rows.size() == 1);
  CHECK(report.null_rows[0] >= 4);
  Eigen::MatrixXd rhs = Eigen::VectorXd::Ones(9);
  CHECK_THROWS_AS(solver->solve(rhs), Error);
}

TEST_CASE("rows without any stiffness are all named") {
  const auto method = GENERATE(from_range(every_method));
  const int digits = GENERATE(8, -1);
  CAPTURE(name_of(method), digits);
  Eigen::MatrixXd dense = chain({1, 1, 1, 1, 1, 1});
  for (const int row : {1, 3}) {
    dense.row(row).setZero();
    dense.col(row).setZero();
  }
  LinearOptions options;
  options.singular_digits = digits;
  auto solver = make_linear_solver(method, options);
  solver->analyse(lower_triangle(dense));
  const FactorReport report = solver->factorise(lower_triangle(dense));
  REQUIRE(report.verdict == FactorVerdict::singular);
  CHECK(report.null_rows == std::vector<int>{1, 3});
}

TEST_CASE("the digits lost on a pivot decide about singularity, and a negative limit never asks") {
  const auto method = GENERATE(from_range(every_method));
  const double weak = GENERATE(1e-5, 1e-11);
  CAPTURE(name_of(method), weak);
  // A chain held by one weak spring: its last pivot is the weak stiffness.
  const Eigen::MatrixXd dense = chain({weak, 1, 1, 1, 0});
  LinearOptions options;
  auto solver = make_linear_solver(method, options);
  solver->analyse(lower_triangle(dense));
  CHECK(solver->factorise(lower_triangle(dense)).verdict ==
        (weak < 1e-8 ? FactorVerdict::singular : FactorVerdict::ok));
  options.singular_digits = -1;
  solver = make_linear_solver(method, options);
  solver->analyse(lower_triangle(dense));
  const FactorReport report = solver->factorise(lower_triangle(dense));
  CHECK(report.verdict == FactorVerdict::ok);
  const int expected = static_cast<int>(-std::log10(weak));
  CHECK(report.lost_digits >= expected - 1);
  CHECK(report.lost_digits <= expected + 1);
  // A unit force at the end of the chain moves it by 1/weak plus the three unit springs in between.
  Eigen::MatrixXd force = Eigen::VectorXd::Unit(4, 3);
  solver->solve(force);
  const double rounded_weak = dense(0, 0) - 1.0;
  CHECK(force(3, 0) == Approx(1.0 / rounded_weak + 3.0).epsilon(1e-13));
}

TEST_CASE("an entry that is not a number is an error that names its row") {
  Eigen::MatrixXd dense = chain({1, 1, 1, 1});
  dense(2, 1) = dense(1, 2) = std::numeric_limits<double>::quiet_NaN();
  auto solver = make_linear_solver(LinearMethod::eigen_ldlt, {});
  CHECK_THROWS_WITH(solver->factorise(lower_triangle(dense)), Catch::Contains("row 2, column 1"));
}

TEST_CASE("a system without unknowns is solved") {
  const auto method = GENERATE(from_range(every_method));
  auto solver = make_linear_solver(method, {});
  const SymmetricMatrix empty(0, 0);
  solver->analyse(empty);
  CHECK(solver->factorise(empty).verdict == FactorVerdict::ok);
  Eigen::MatrixXd rhs(0, 3);
  CHECK(solver->solve(rhs) == 0.0);
}

TEST_CASE("small positive definite systems stay inside the program, large ones go to CHOLMOD") {
  CHECK(choose_method(lower_triangle(chain({1, 1, 1}))) == LinearMethod::eigen_ldlt);
  SymmetricMatrix identity(small_system + 1, small_system + 1);
  identity.setIdentity();
  CHECK(choose_method(identity) == LinearMethod::cholmod);
}

TEST_CASE("conjugate gradients reach the residual asked for, and say so when they cannot") {
  const Eigen::MatrixXd dense = chain(std::vector<double>(201, 3.0));
  const Eigen::MatrixXd expected = random_integers(200, 2, 5);
  LinearOptions options;
  options.iteration_tolerance = 1e-12;
  auto solver = make_linear_solver(LinearMethod::conjugate_gradient, options);
  CHECK(solver->factorise(lower_triangle(dense)).verdict == FactorVerdict::ok);
  CHECK(solve_error(*solver, dense, expected) < 1e-8);
  SECTION("too few iterations") {
    // A band of many couplings, for which the incomplete factor is not the factor itself.
    const Eigen::MatrixXd root = random_integers(60, 60, 1);
    const Eigen::MatrixXd full = root * root.transpose() + Eigen::MatrixXd::Identity(60, 60);
    Eigen::MatrixXd sparse = full;
    for (int i = 0; i < 60; ++i) sparse(i, i) += 60.0 * 81.0;
    options.most_iterations = 1;
    options.iteration_tolerance = 1e-15;
    solver = make_linear_solver(LinearMethod::conjugate_gradient, options);
    solver->factorise(lower_triangle(sparse));
    Eigen::MatrixXd x = random_integers(60, 1, 3);
    CHECK_THROWS_AS(solver->solve(x), Error);
  }
}

}  // namespace linear_solver_test
