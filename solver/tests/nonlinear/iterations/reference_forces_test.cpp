#include "solver/nonlinear/iterations/reference_forces.hpp"

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/nonlinear/iterations/convergence.hpp"
#include "solver/tests/exactly.hpp"
#include "solver/tests/nonlinear/scene.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

TEST_CASE("The reference force of a corner is the stress times half a side, once for each direction, over the points") {
  Scene scene;
  const auto block = scene.block("b", {0, 0}, {2, 2}, 1, 1, 1000.0, 0.0);
  const DofMap dofs(*scene.problem.model);
  ReferenceEfforts efforts;
  efforts.stress = 7.0;
  // The integral of |dN/dx| over the square is half of its height.
  const Eigen::VectorXd forces = reference_forces(*scene.problem.model, dofs, efforts);
  for (const auto& row : block.nodes)
    for (const int node : row) CHECK(forces[dofs.dof(node, Component::dx)] == exactly(7.0 * (1.0 + 1.0) / 4.0));
}

TEST_CASE("Where cells meet the least reference force counts; round an axis the radius has a share") {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{1, 0, 0}, {2, 0, 0}, {4, 0, 0}, {1, 1, 0}, {2, 1, 0}, {4, 1, 0}};
  mesh->add_cell(CellType::quad4, std::vector<int>{0, 1, 4, 3});
  mesh->add_cell(CellType::quad4, std::vector<int>{1, 2, 5, 4});
  ReferenceEfforts efforts;
  efforts.stress = 1.0;
  const auto at = [&](Formulation formulation, int node, Component component) {
    const Model model{mesh, {formulation, formulation}};
    const DofMap dofs(model);
    return reference_forces(model, dofs, efforts)[dofs.dof(node, component)];
  };
  CHECK(at(Formulation::plane_strain, 1, Component::dx) == exactly((0.5 + 0.5) / 4.0));
  CHECK(at(Formulation::plane_strain, 2, Component::dx) == exactly((1.0 + 0.5) / 4.0));
  // Code_Aster 17.3, to five digits.
  CHECK(at(Formulation::axisymmetric, 1, Component::dx) == Approx(0.45833).epsilon(2e-5));
  CHECK(at(Formulation::axisymmetric, 1, Component::dy) == Approx(0.39583).epsilon(2e-5));
  CHECK(at(Formulation::axisymmetric, 2, Component::dx) == Approx(1.33333).epsilon(1e-5));
}

TEST_CASE("Corners of mixed elements have their share of the volume times the strain and the stress") {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}};
  mesh->add_cell(CellType::quad8, std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7});
  const Model model{mesh, {Formulation::plane_strain_swelling}};
  const DofMap dofs(model);
  ReferenceEfforts efforts;
  efforts.stress = 7.0;
  CHECK_THROWS_WITH(reference_forces(model, dofs, efforts), Catch::Contains("EPSI_REFE"));
  efforts.strain = 0.01;
  const Eigen::VectorXd forces = reference_forces(model, dofs, efforts);
  for (int corner = 0; corner < 4; ++corner) {
    CHECK(forces[dofs.dof(corner, Component::pressure)] == exactly(0.01 * 1.0));
    CHECK(forces[dofs.dof(corner, Component::swelling)] == exactly(7.0 * 1.0));
  }
}

TEST_CASE("Structures take the resultants themselves, and an effort that lacks is named") {
  Scene scene;
  const int node = scene.node("A", 0, 0);
  scene.ground_spring("k", node, 1.0, 1.0);
  const DofMap dofs(*scene.problem.model);
  ReferenceEfforts efforts;
  CHECK_THROWS_WITH(reference_forces(*scene.problem.model, dofs, efforts), Catch::Contains("EFFORT_REFE"));
  efforts.force = 3.0;
  CHECK(reference_forces(*scene.problem.model, dofs, efforts)[dofs.dof(node, Component::dy)] == 3.0);
}

TEST_CASE("Residuals of each kind of component are measured against internal forces of that kind") {
  Scene scene;
  const int node = scene.node("A", 0, 0);
  scene.ground_spring("k", node, 1.0, 1.0);
  const DofMap dofs(*scene.problem.model);
  const Elimination elimination(*scene.mesh, dofs, {});
  ReferenceForces reference(*scene.problem.model, dofs, elimination, NewtonOptions{});
  Eigen::VectorXd forces(2), residual(2);
  residual[dofs.dof(node, Component::dx)] = 1.0;
  residual[dofs.dof(node, Component::dy)] = 0.5;
  CHECK_FALSE(reference.share_by_component(residual));
  forces[dofs.dof(node, Component::dx)] = -100.0;
  forces[dofs.dof(node, Component::dy)] = 10.0;
  reference.begin_step(forces);
  CHECK(*reference.share_by_component(residual) == exactly(0.05));
  // A kind without forces takes the largest of all.
  forces[dofs.dof(node, Component::dy)] = 0.0;
  reference.begin_step(forces);
  CHECK(*reference.share_by_component(residual) == exactly(0.01));
}

TEST_CASE("What the balance of pressures lacks is measured against forces, whatever it lacked when the step began") {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 2;
  mesh->nodes = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}};
  mesh->add_cell(CellType::quad8, std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7});
  const Model model{mesh, {Formulation::plane_strain_swelling}};
  const DofMap dofs(model);
  const Elimination elimination(*mesh, dofs, {});
  ReferenceForces reference(model, dofs, elimination, NewtonOptions{});
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(dofs.size()), residual = forces;
  forces[dofs.dof(5, Component::dy)] = -100.0;
  residual[dofs.dof(1, Component::pressure)] = 1.0;
  residual[dofs.dof(1, Component::swelling)] = 2.0;
  for (const double left_over : {0.0, 1e-30, 1e-6}) {
    forces[dofs.dof(2, Component::pressure)] = forces[dofs.dof(2, Component::swelling)] = left_over;
    reference.begin_step(forces);
    CHECK(*reference.share_by_component(residual) == exactly(0.02));
  }
}

TEST_CASE("RESI_COMP_RELA takes the loads where no internal force is known") {
  NewtonOptions options;
  options.relative_residual.reset();
  options.component_residual = 1e-3;
  CHECK(ConvergenceCriterion(options).measure(0.9, 1000.0, false).converged);
  CHECK_FALSE(ConvergenceCriterion(options).measure(0.9, 1000.0, false, 0.0, 0.9e-2).converged);
  CHECK(ConvergenceCriterion(options).measure(10.0, 1000.0, false, 0.0, 0.9e-3).converged);
}

TEST_CASE("RESI_REFE_RELA alone, or with others") {
  NewtonOptions options;
  options.relative_residual.reset();
  options.referred_residual = 1e-3;
  CHECK(ConvergenceCriterion(options).measure(10.0, 1.0, false, 0.9e-3).converged);
  CHECK_FALSE(ConvergenceCriterion(options).measure(1e-9, 1.0, false, 1.1e-3).converged);
  options.relative_residual = 1e-6;
  CHECK_FALSE(ConvergenceCriterion(options).measure(10.0, 1.0, false, 0.9e-3).converged);
  options.one_criterion = true;
  CHECK(ConvergenceCriterion(options).measure(10.0, 1.0, false, 0.9e-3).converged);
}
