#include "solver/contact_law/nodal_step.hpp"

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/coupled_points.hpp"

using namespace comma::solver;

TEST_CASE("Contact solved by products with the compliance is that of the direct way") {
  CoupledSurface direct(12), by_products(12);
  by_products.problem.direct_rows = 0;
  by_products.problem.most_direct_rows = 0;
  const CondensedSolution expected = solve_condensed(direct.schur, direct.problem, direct.state);
  const CondensedSolution solution = solve_condensed(by_products.schur, by_products.problem, by_products.state);
  REQUIRE(expected.verdict == CondensedVerdict::solved);
  REQUIRE(solution.verdict == CondensedVerdict::solved);
  for (const int count : direct.counts()) CHECK(count > 0);
  CHECK(by_products.state.statuses == direct.state.statuses);
  CHECK((solution.forces - expected.forces).norm() < 1e-10 * expected.forces.norm());
  CHECK((by_products.state.multipliers - direct.state.multipliers).norm() < 1e-10 * direct.state.multipliers.norm());
}

TEST_CASE("So is contact whose multipliers are interpolated to points between nodes") {
  CoupledSurface direct(12), by_products(12), followed(12);
  for (CoupledSurface* each : {&direct, &by_products, &followed}) each->share_multipliers(12);
  direct.problem.direct_rows_between = 1000;
  for (CoupledSurface* each : {&by_products, &followed}) each->problem.direct_rows_between = 0;
  followed.problem.most_products = 1;
  const CondensedSolution expected = solve_condensed(direct.schur, direct.problem, direct.state);
  REQUIRE(expected.verdict == CondensedVerdict::solved);
  for (const int count : direct.counts()) CHECK(count > 0);
  for (CoupledSurface* each : {&by_products, &followed}) {
    const CondensedSolution solution = solve_condensed(each->schur, each->problem, each->state);
    REQUIRE(solution.verdict == CondensedVerdict::solved);
    CHECK(each->state.statuses == direct.state.statuses);
    CHECK((solution.forces - expected.forces).norm() < 1e-9 * expected.forces.norm());
  }
  CHECK(followed.state.multipliers == direct.state.multipliers);
  CHECK(by_products.state.multipliers != direct.state.multipliers);
}

TEST_CASE("Where products with the compliance lead nowhere, the direct way follows, or no solution") {
  CoupledSurface direct(12), followed(12), bounded(12);
  for (CoupledSurface* each : {&followed, &bounded}) {
    each->problem.direct_rows = 0;
    each->problem.most_products = 2;
  }
  bounded.problem.most_direct_rows = 0;
  const CondensedSolution expected = solve_condensed(direct.schur, direct.problem, direct.state);
  const CondensedSolution solution = solve_condensed(followed.schur, followed.problem, followed.state);
  REQUIRE(solution.verdict == CondensedVerdict::solved);
  CHECK((solution.forces - expected.forces).norm() == 0.0);
  CHECK(solve_condensed(bounded.schur, bounded.problem, bounded.state).verdict ==
        CondensedVerdict::too_many_iterations);
}
