#include "solver/contact/interpolated_step.hpp"

#include <catch2/catch.hpp>

#include "solver/tests/contact/coupled_points.hpp"

using namespace comma::solver;

namespace {

constexpr int rows = 4, laws = 3;

/// Forces of the multipliers and, little, of the jumps; laws that neither a row nor a multiplier decides alone.
InterpolatedStep example(double by_jump) {
  InterpolatedStep step({0, 1, 2, 3}, rows + laws);
  for (int row = 0; row < rows; ++row) {
    step.add_force_derivative(row, row, by_jump);
    for (int law = 0; law < laws; ++law) {
      step.add_force_derivative(row, rows + law, 1.0 / (1.0 + std::abs(row - law)));
      step.add_law_derivative(rows + law, row, row == law ? 1.0 : 0.2);
    }
  }
  for (int law = 0; law < laws; ++law) step.add_law_derivative(rows + law, rows + law, 0.1 * law);
  return step;
}

/// What is left of the equations, as a share of b.
double left(const InterpolatedStep& step, SchurComplement& schur, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
  Eigen::VectorXd residual(rows + laws);
  residual << x.head(rows) - schur.times(step.forces() * x), step.laws() * x;
  return (residual - b).norm() / b.norm();
}

}  // namespace

TEST_CASE("Steps of interpolated multipliers are solved with the factors of the same step alone") {
  SchurComplement schur(identity_rows(rows), Coupled::compliance(rows));
  const std::vector<int> all{0, 1, 2, 3};
  InterpolatedSolver solver;
  const auto check = [&](const InterpolatedStep& step) {
    schur.require(all);
    for (const double other : {1.0, -3.0}) {
      Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(rows + laws, -1.0, 2.0);
      b[2] = other;
      CHECK(left(step, schur, solver.solve(step, schur, b), b) < 1e-13);
      const auto by_products = solver.solve_by_products(step, schur, b, {.tolerance = 1e-12, .most_products = 20});
      REQUIRE(by_products);
      CHECK(left(step, schur, *by_products, b) < 1e-10);
    }
  };
  check(example(-0.05));
  check(example(-0.1));
  RowMatrix wider = 2.0 * identity_rows(rows);
  schur.replace_rows(wider);
  check(example(-0.1));
}
