#include "solver/contact_law/interpolated_step.hpp"

#include <algorithm>
#include <numeric>

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/coupled_points.hpp"

using namespace comma::solver;

namespace {

/// Forces of the multipliers and, little, of the jumps; laws that neither a row nor a multiplier decides alone.
InterpolatedStep example(int rows, double by_jump) {
  const int laws = rows - 1;
  std::vector<int> all(static_cast<std::size_t>(rows));
  std::iota(all.begin(), all.end(), 0);
  InterpolatedStep step(all, rows + laws);
  for (int row = 0; row < rows; ++row) {
    step.add_force_derivative(row, row, by_jump);
    for (int law = std::max(0, row - 2); law < std::min(laws, row + 3); ++law) {
      step.add_force_derivative(row, rows + law, 1.0 / (1.0 + std::abs(row - law)));
      step.add_law_derivative(rows + law, row, row == law ? 1.0 : 0.2);
    }
  }
  for (int law = 0; law < laws; ++law) {
    step.add_law_derivative(rows + law, rows + law, 0.1 * (law % 3));
    step.add_law_weight(rows + law, 1.0);
  }
  return step;
}

/// What is left of the equations, as a share of b.
double left(const InterpolatedStep& step, SchurComplement& schur, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
  Eigen::VectorXd residual(b.size());
  residual << x.head(step.row_count()) - schur.times(step.forces() * x), step.laws() * x;
  return (residual - b).norm() / b.norm();
}

}  // namespace

TEST_CASE("Steps of interpolated multipliers are solved with the factors of the same step alone") {
  constexpr int rows = 4;
  SchurComplement schur(identity_rows(rows), Coupled::compliance(rows));
  InterpolatedSolver solver;
  const auto check = [&](const InterpolatedStep& step) {
    schur.require(step.rows());
    for (const double other : {1.0, -3.0}) {
      Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(step.unknowns(), -1.0, 2.0);
      b[2] = other;
      CHECK(left(step, schur, solver.solve(step, schur, b), b) < 1e-13);
      const auto by_products = solver.solve_by_products(step, schur, b, {.tolerance = 1e-12, .most_products = 20});
      REQUIRE(by_products);
      CHECK(left(step, schur, *by_products, b) < 1e-10);
    }
  };
  check(example(rows, -0.05));
  check(example(rows, -0.1));
  RowMatrix wider = 2.0 * identity_rows(rows);
  schur.replace_rows(wider);
  check(example(rows, -0.1));
}

TEST_CASE("Or with those of a step that is little different, to the tolerance") {
  constexpr int rows = 600;
  SchurComplement schur(identity_rows(rows), Coupled::compliance(rows));
  InterpolatedSolver solver;
  const auto left_of = [&](const InterpolatedStep& step) {
    schur.require(step.rows());
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(step.unknowns(), -1.0, 2.0);
    const auto x = solver.solve_by_products(step, schur, b, {.tolerance = 1e-2, .most_products = 100});
    REQUIRE(x);
    return left(step, schur, *x, b);
  };
  CHECK(left_of(example(rows, 0.0)) < 1e-10);
  const double near = left_of(example(rows, -1e-3));
  CHECK(near < 1e-2);
  CHECK(near > 1e-10);
  CHECK(left_of(example(rows, 0.0)) < 1e-10);
}

TEST_CASE("Faces of any area are solved as well: a point that is open shares a multiplier with one that is closed") {
  constexpr int rows = 2;
  SchurComplement schur(identity_rows(rows), Coupled::compliance(rows));
  for (const double area : {1.0, 1e-8, 1e-16}) {
    InterpolatedStep step({0, 1}, rows + 3);
    for (int row = 0; row < rows; ++row)
      for (int law = 0; law < 2; ++law) {
        const double share = area * (row == law ? 0.8 : 0.2);
        step.add_force_derivative(row, rows + law, share);
        step.add_law_derivative(rows + law, row, share);
        step.add_law_weight(rows + law, share);
      }
    // A third point, between the second node and one more, is open: its law is one of pressures alone, and lengths of
    // it are small beside those of jumps.
    const double length = 1e-4 * area;
    for (const int law : {rows + 1, rows + 2}) {
      step.add_law_weight(law, 0.5 * area);
      for (const int other : {rows + 1, rows + 2})
        step.add_law_derivative(law, other, (law == other ? 0.3 : 0.2) * area * length);
    }
    schur.require(step.rows());
    Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(step.unknowns(), -1.0, 2.0);
    b.tail(step.law_count()) *= area;
    InterpolatedSolver solver;
    const Eigen::VectorXd x = solver.solve(step, schur, b);
    Eigen::VectorXd residual(b.size());
    residual << x.head(rows) - schur.times(step.forces() * x), step.laws() * x;
    CHECK(step.in_lengths(residual - b).norm() < 1e-10 * step.in_lengths(b).norm());
  }
}
