#include "solver/nonlinear/iterations/convergence.hpp"

#include <limits>

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;

TEST_CASE("loads and reactions count with the size of what command variables push with, whatever the signs") {
  const Eigen::Vector3d loads(3.0, 0.0, 0.0), internal(3.0, -2.0, 0.0);
  CHECK(load_size(loads, internal, {}) == 3.0);
  CHECK(load_size(loads, internal, Eigen::Vector3d(-1.0, 1.0, 3.5)) == 4.0);
  CHECK(load_size(loads, internal, Eigen::Vector3d(1.0, -5.0, 3.5)) == 7.0);  // the reaction is 2
}

TEST_CASE("By default a millionth of the load is asked") {
  const ConvergenceCriterion criterion(NewtonOptions{});
  CHECK(criterion.measure(0.9e-3, 1000.0, false).converged);
  CHECK_FALSE(criterion.measure(1.1e-3, 1000.0, false).converged);
  CHECK(criterion.measure(1.1e-3, 1000.0, false).relative == exactly(1.1e-6));
}

TEST_CASE("Both criteria are asked when both are given, one when one is") {
  NewtonOptions options;
  options.absolute_residual = 1e-5;
  CHECK_FALSE(ConvergenceCriterion(options).measure(1e-4, 1000.0, false).converged);
  CHECK_FALSE(ConvergenceCriterion(options).measure(1e-5, 1.0, false).converged);
  options.relative_residual.reset();
  CHECK(ConvergenceCriterion(options).measure(1e-5, 1.0, false).converged);
  // Rounding is no excuse for an absolute limit, which the user chose in newtons.
  CHECK_FALSE(ConvergenceCriterion(options).measure(1e-4, 1000.0, true).converged);
}

TEST_CASE("Where the loads vanish the residual of the least loaded step is asked") {
  ConvergenceCriterion criterion(NewtonOptions{});
  criterion.accept(5000.0);
  criterion.accept(2000.0);
  const auto unloaded = criterion.measure(1e-3, 1e-9, false);
  CHECK(unloaded.converged);
  CHECK(unloaded.relative == -1.0);
  CHECK_FALSE(criterion.measure(3e-3, 1e-9, false).converged);
  CHECK_FALSE(criterion.measure(1e-3, 10.0, false).converged);  // a small load is a load
}

TEST_CASE("A body that has been unloaded is loaded and unloaded again") {
  ConvergenceCriterion criterion(NewtonOptions{});
  for (int turn = 0; turn < 3; ++turn) {
    criterion.accept(2000.0);
    CHECK(criterion.measure(1e-3, 1e-13, false).converged);
    criterion.accept(1e-13);
    CHECK_FALSE(criterion.measure(3e-3, 1e-13, false).converged);
  }
}

TEST_CASE("What rounding leaves of loads that have gone is no load") {
  ConvergenceCriterion criterion(NewtonOptions{});
  criterion.accept(1e-14);  // a body that moved freely
  criterion.accept(30.0);
  CHECK(criterion.measure(1e-13, 1e-13, false).converged);
  // Contact that the first geometry of a step had and the next has not.
  ConvergenceCriterion first(NewtonOptions{});
  CHECK_FALSE(first.measure(1e-13, 1e-13, false).converged);
  first.take_up(50.0);
  CHECK(first.measure(1e-13, 1e-13, false).converged);
  CHECK_FALSE(first.measure(1e-9, 1e-9, false).converged);
}

TEST_CASE("Rounding passes the relative test, what is not a number passes none") {
  const ConvergenceCriterion criterion(NewtonOptions{});
  CHECK(criterion.measure(1e-13, 1e-13, true).converged);
  CHECK_FALSE(criterion.measure(1e-13, 1e-13, false).converged);
  CHECK_FALSE(criterion.measure(std::numeric_limits<double>::quiet_NaN(), 1.0, true).converged);
}

TEST_CASE("One of two criteria is enough where the user says so") {
  NewtonOptions options;
  options.absolute_residual = 1e-5;
  options.one_criterion = true;
  CHECK(ConvergenceCriterion(options).measure(1e-4, 1000.0, false).converged);
  CHECK(ConvergenceCriterion(options).measure(1e-5, 1.0, false).converged);
  CHECK_FALSE(ConvergenceCriterion(options).measure(1e-2, 1000.0, false).converged);
}
