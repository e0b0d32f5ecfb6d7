#include "solver/elements/solids/locking.hpp"

#include <Eigen/Eigenvalues>

#include <catch2/catch.hpp>

#include "solver/tests/elements/sample_meshes.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

bool at_risk(CellType type, Formulation formulation, double poisson) {
  const Body body(single_cell(type), formulation, elastic(2e11, poisson));
  return find_locking(body.model, body.materials).has_value();
}

/// Of the stiffness of a curved cell, over its largest.
double least_eigenvalue(Formulation formulation, double poisson) {
  const Body body(single_cell(CellType::tetra10, 0.3), formulation, elastic(2e11, poisson));
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(body.dense_stiffness()).eigenvalues();
  return values.minCoeff() / values.maxCoeff();
}

}  // namespace

TEST_CASE("linear cells are at risk of locking before quadratic ones, reduced and plane stress ones never",
          "[elements]") {
  CHECK_FALSE(at_risk(CellType::quad4, Formulation::plane_strain, 0.3));
  CHECK(at_risk(CellType::quad4, Formulation::plane_strain, 0.495));
  CHECK(at_risk(CellType::hexa8, Formulation::solid, 0.495));
  CHECK_FALSE(at_risk(CellType::quad8, Formulation::axisymmetric, 0.495));
  CHECK(at_risk(CellType::quad8, Formulation::axisymmetric, 0.4995));
  CHECK_FALSE(at_risk(CellType::quad8, Formulation::plane_strain_reduced, 0.4999));
  CHECK_FALSE(at_risk(CellType::quad4, Formulation::plane_stress, 0.4999));
  CHECK_FALSE(at_risk(CellType::quad8, Formulation::plane_strain_pressure, 0.4999));
  CHECK_FALSE(at_risk(CellType::hexa20, Formulation::solid_swelling, 0.4999));
}

TEST_CASE("the risk of locking counts body cells, not their skin", "[elements]") {
  auto mesh = single_cell(CellType::quad4);
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  mesh->add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  const Body body(mesh, Formulation::plane_strain, elastic(2e11, 0.499));
  const auto risk = find_locking(body.model, body.materials);
  REQUIRE(risk);
  CHECK(risk->cells == 2);
  CHECK(risk->first_cell == 0);
  CHECK(risk->poisson == 0.499);
}

// The five-point rule of TETRA10 is exact on straight cells, but has a negative weight in its centre: in a curved cell
// whose material resists changes of volume ever more, a motion that changes the volume most there gives energy. The
// four-point rule has none.
TEST_CASE("curved TETRA10 lose positive energy near incompressibility, but not with reduced integration",
          "[elements]") {
  constexpr double rounding = 1e-12;
  CHECK(least_eigenvalue(Formulation::solid, 0.3) > -rounding);
  CHECK(least_eigenvalue(Formulation::solid, 0.4999) < -1e-4);
  CHECK(least_eigenvalue(Formulation::solid_reduced, 0.4999) > -rounding);
}
