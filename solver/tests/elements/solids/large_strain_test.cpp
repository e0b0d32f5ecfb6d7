#include <catch2/catch.hpp>

#include "solver/elements/assembler.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace large_strain_test {

constexpr double young = 1000.0;
constexpr double poisson = 0.3;

/// Two stacked cells of a body, distorted, in large strains.
struct Body {
  Model model;
  MaterialField materials;
  ElementProperties properties;
  BehaviourOfCells behaviours;

  Body(Formulation formulation, bool solid) {
    model.mesh = std::make_shared<Mesh>();
    Mesh& mesh = *model.mesh;
    mesh.dimension = solid ? 3 : 2;
    if (solid) {
      mesh.nodes = {{0, 0, 0}, {1, 0, 0.1}, {1.1, 1, 0}, {0, 1, 0}, {0, 0.1, 1}, {1, 0, 1}, {1, 1, 1.2}, {0.1, 1, 1}};
      mesh.add_cell(CellType::hexa8, std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7});
    } else {
      mesh.nodes = {{1, 0, 0}, {2, 0.1, 0}, {2.1, 1, 0}, {1, 1, 0}, {2, 2, 0}, {1.1, 2.1, 0}};
      mesh.add_cell(CellType::quad4, std::vector<int>{0, 1, 2, 3});
      mesh.add_cell(CellType::quad4, std::vector<int>{3, 2, 4, 5});
    }
    const auto count = static_cast<std::size_t>(mesh.cell_count());
    model.formulations.assign(count, formulation);
    Material material;
    material.elasticity = IsotropicElasticity{young, poisson};
    materials.by_cell.assign(count, std::make_shared<const Material>(material));
    behaviours.assign(count, {Kinematics::green_lagrange});
  }
};

Eigen::VectorXd rough(int size, double amplitude) {
  Eigen::VectorXd u(size);
  for (int k = 0; k < size; ++k) u[k] = amplitude * std::sin(1.0 + 3.0 * k);
  return u;
}

TEST_CASE("the tangent of large strains is the derivative of the internal forces, but for the hoops") {
  const auto [formulation, solid] =
      GENERATE(std::pair{Formulation::solid, true}, std::pair{Formulation::plane_strain, false},
               std::pair{Formulation::plane_stress, false}, std::pair{Formulation::axisymmetric, false});
  const Body body(formulation, solid);
  const DofMap dofs(body.model);
  const Assembler assembler(body.model, body.materials, body.properties, dofs, &body.behaviours);
  const Eigen::VectorXd u = rough(dofs.size(), 0.15);
  const Eigen::MatrixXd lower = assembler.stiffness(u);
  const Eigen::MatrixXd tangent = lower.selfadjointView<Eigen::Lower>();
  constexpr double step = 1e-6;
  for (int k = 0; k < dofs.size(); ++k) {
    Eigen::VectorXd ahead = u;
    Eigen::VectorXd behind = u;
    ahead[k] += step;
    behind[k] -= step;
    const Eigen::VectorXd column = (assembler.internal_forces(ahead) - assembler.internal_forces(behind)) / (2 * step);
    Eigen::VectorXd difference = tangent.col(k) - column;
    // A radial force from radial displacements lacks the stress of the hoops.
    if (formulation == Formulation::axisymmetric && k % 2 == 0) difference(Eigen::seq(0, Eigen::last, 2)).setZero();
    // Central differences: the third derivative (young) times the square of the step, and rounding over the step.
    CHECK(difference.cwiseAbs().maxCoeff() < 1e-6 * young);
  }
}

TEST_CASE("a finite rotation strains nothing, and stretching a turned block gives Cauchy's stress in its axes") {
  const Body body(Formulation::solid, true);
  const DofMap dofs(body.model);
  const Assembler assembler(body.model, body.materials, body.properties, dofs, &body.behaviours);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto displaced = [&](const Eigen::Matrix3d& gradient) {
    Eigen::VectorXd u(dofs.size());
    for (int node = 0; node < body.model.mesh->node_count(); ++node) {
      const Point& at = body.model.mesh->nodes[static_cast<std::size_t>(node)];
      const Eigen::Vector3d x(at[0], at[1], at[2]);
      u.segment<3>(dofs.first_dof(node)) = gradient * x - x;
    }
    return u;
  };
  CHECK(assembler.internal_forces(displaced(turn)).cwiseAbs().maxCoeff() < 1e-12 * young);
  constexpr double stretch = 1.1;
  const Eigen::Matrix3d gradient = turn * Eigen::Vector3d(stretch, 1.0, 1.0).asDiagonal();
  const ElementField field = assembler.stresses(displaced(gradient));
  // E11 = (stretch^2 - 1) / 2 alone; S11 = (lambda + 2 mu) E11, S22 = S33 = lambda E11; sigma = F S F^T / J.
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const double mu = young / (2 * (1 + poisson));
  const double strain = 0.5 * (stretch * stretch - 1);
  const Eigen::Vector3d second((lambda + 2 * mu) * strain, lambda * strain, lambda * strain);
  const Eigen::Matrix3d cauchy = gradient * second.asDiagonal() * gradient.transpose() / stretch;
  CHECK(field.at(0, 0, field.component("SIXX")) == exactly(cauchy(0, 0)));
  CHECK(field.at(0, 0, field.component("SIYZ")) == exactly(cauchy(1, 2)));
}

}  // namespace large_strain_test
