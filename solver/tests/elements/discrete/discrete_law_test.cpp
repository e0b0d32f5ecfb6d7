#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/elements/sample_meshes.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace discrete_law_test {

/// From the origin to (1, 2, 2).
Body segment(const SpringLaws& laws) {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 3;
  mesh->nodes = {{0, 0, 0}, {1, 2, 2}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  ElementProperties properties;
  properties.discrete[0] = diagonal_stiffness(*mesh, 0, Formulation::spring_rotation_3d,
                                              std::array{5.0, 6.0, 7.0, 8.0, 9.0, 10.0}, DiscreteFrame::local);
  Material material;
  material.springs = laws;
  material.knows_bilinear_springs = material.knows_hardening_springs = true;
  return Body(mesh, std::vector<Formulation>{Formulation::spring_rotation_3d},
              std::make_shared<const Material>(material), properties);
}

SpringLaws laws() {
  SpringLaws laws;
  laws.bilinear[0] = BilinearSpring{3.0, 0.5, 0.2};
  laws.bilinear[2] = BilinearSpring{3.0, 4.0, 20.0};
  laws.hardening[1] = HardeningSpring{0.3, 2.0, 3.0, 0.7};
  laws.hardening[3] = HardeningSpring{0.1, 1.0, 0.0, 0.0};
  return laws;
}

Eigen::VectorXd moved() {
  Eigen::VectorXd u(12);
  for (int i = 0; i < 12; ++i) u[i] = 0.3 * std::sin(1.0 + 2.0 * i);
  return u;
}

TEST_CASE("the tangent of a segment with a law for each component is the derivative of its forces, which balance",
          "[elements]") {
  const Body body = segment(laws());
  for (const Relation relation : {Relation::bilinear_spring, Relation::hardening_spring}) {
    const BehaviourOfCells behaviour = {{Kinematics::small, relation}};
    Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &behaviour);
    const Eigen::VectorXd u = moved();
    const Eigen::MatrixXd tangent = full_matrix(assembler.stiffness(u), assembler.skew_stiffness(u));
    constexpr double h = 1e-6;
    for (int k = 0; k < 12; ++k) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(12, k);
      const Eigen::VectorXd column =
          (assembler.internal_forces(u + step) - assembler.internal_forces(u - step)) / (2 * h);
      CHECK((column - tangent.col(k)).norm() <= 1e-7);
    }
    const Eigen::VectorXd forces = assembler.internal_forces(u);
    CHECK((forces.head<6>() + forces.tail<6>()).norm() <= 1e-14 * forces.norm());
    CHECK((assembler.forces_of_stresses(u, assembler.stresses(u)) - forces).norm() <= 1e-12);
  }
}

TEST_CASE("a segment that has flowed goes on from its force or its variables as if it had never stopped",
          "[elements]") {
  const Body body = segment(laws());
  const BehaviourOfCells behaviour = {{Kinematics::small, Relation::hardening_spring}};
  const Eigen::VectorXd u = moved(), later = -0.2 * u;
  Assembler whole(body.model, body.materials, body.properties, *body.dofs, &behaviour);
  whole.accept(u);
  const ElementField stresses = whole.stresses(u), variables = whole.internal_variables(u);
  for (const ElementField* given : {&variables, static_cast<const ElementField*>(nullptr)}) {
    Assembler resumed(body.model, body.materials, body.properties, *body.dofs, &behaviour);
    resumed.resume(u, &stresses, given);
    CHECK((resumed.internal_forces(later) - whole.internal_forces(later)).norm() <= 1e-12);
  }
}

TEST_CASE("laws of components ask for their material and for a stiffness that couples none", "[elements]") {
  const BehaviourOfCells behaviour = {{Kinematics::small, Relation::hardening_spring}};
  Body lacking = segment(laws());
  lacking.materials.by_cell[0] = elastic(1.0, 0.0);
  CHECK_THROWS_WITH(Assembler(lacking.model, lacking.materials, lacking.properties, *lacking.dofs, &behaviour),
                    Catch::Contains("lacks"));
  Body coupled = segment(laws());
  coupled.properties.discrete[0].matrix(0, 3) = coupled.properties.discrete[0].matrix(3, 0) = 1.0;
  CHECK_THROWS_WITH(Assembler(coupled.model, coupled.materials, coupled.properties, *coupled.dofs, &behaviour),
                    Catch::Contains("couples"));
}

}  // namespace discrete_law_test
