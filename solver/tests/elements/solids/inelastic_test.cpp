#include <catch2/catch.hpp>

#include "solver/elements/assembler.hpp"
#include "solver/error.hpp"
#include "solver/tests/elements/sample_meshes.hpp"

using namespace comma::solver;

namespace inelastic_test {

constexpr double young = 1000.0;

/// One distorted cell of a metal that has flowed, moved and turned before.
struct Flowed {
  Model model;
  MaterialField materials;
  ElementProperties properties;
  BehaviourOfCells behaviours;
  std::unique_ptr<DofMap> dofs;
  std::unique_ptr<Assembler> assembler;

  Flowed(CellType type, Formulation formulation, CellBehaviour behaviour) {
    model.mesh = testing::single_cell(type, 0.1);
    model.formulations = {formulation};
    Material material;
    material.elasticity = IsotropicElasticity{young, 0.3};
    material.plasticity.linear = LinearHardening{50.0, 5.0};
    material.plasticity.prager = Property(20.0);
    materials.by_cell = {std::make_shared<const Material>(material)};
    behaviours = {behaviour};
    dofs = std::make_unique<DofMap>(model);
    assembler = std::make_unique<Assembler>(model, materials, properties, *dofs, &behaviours);
    assembler->accept(rough(0.03));
  }

  Eigen::VectorXd rough(double amplitude) const {
    Eigen::VectorXd u(dofs->size());
    for (int k = 0; k < dofs->size(); ++k) u[k] = amplitude * std::sin(1.0 + 3.0 * k);
    return u;
  }
};

TEST_CASE("ELASTIQUE is the stiffness of small strains on the initial geometry, wherever a body has gone") {
  const Kinematics kinematics =
      GENERATE(Kinematics::small, Kinematics::updated, Kinematics::green_lagrange, Kinematics::logarithmic);
  const Relation relation = GENERATE(Relation::elastic, Relation::isotropic_linear);
  const auto [type, formulation] =
      GENERATE(std::pair{CellType::hexa8, Formulation::solid}, std::pair{CellType::quad8, Formulation::plane_stress},
               std::pair{CellType::quad4, Formulation::axisymmetric});
  const Flowed body(type, formulation, {kinematics, relation});
  Flowed at_rest(type, formulation, {Kinematics::small, Relation::elastic});
  const Eigen::MatrixXd expected = at_rest.assembler->stiffness(Eigen::VectorXd::Zero(at_rest.dofs->size()));
  const Eigen::MatrixXd found = body.assembler->initial_stiffness(body.rough(0.06));
  CHECK((found - expected).norm() < 1e-12 * expected.norm());
  CHECK(body.assembler->is_initially_linear());
}

TEST_CASE("the tangent of an inelastic body is the derivative of its internal forces, but for the hoops") {
  const auto [type, formulation] = GENERATE(
      std::pair{CellType::hexa8, Formulation::solid}, std::pair{CellType::tetra10, Formulation::solid},
      std::pair{CellType::quad8, Formulation::plane_strain}, std::pair{CellType::quad4, Formulation::axisymmetric},
      std::pair{CellType::tria6, Formulation::plane_stress});
  const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::logarithmic);
  const Relation relation = GENERATE(Relation::isotropic_linear, Relation::mixed_linear);
  const Flowed body(type, formulation, {kinematics, relation});
  const Eigen::VectorXd u = body.rough(0.06);
  const Eigen::MatrixXd lower = body.assembler->stiffness(u);
  const Eigen::MatrixXd tangent = lower.selfadjointView<Eigen::Lower>();
  constexpr double step = 1e-6;
  for (int k = 0; k < body.dofs->size(); ++k) {
    Eigen::VectorXd ahead = u, behind = u;
    ahead[k] += step;
    behind[k] -= step;
    const Eigen::VectorXd column =
        (body.assembler->internal_forces(ahead) - body.assembler->internal_forces(behind)) / (2 * step);
    Eigen::VectorXd difference = tangent.col(k) - column;
    // In large strains a radial force from radial displacements lacks the stress of the hoops.
    if (formulation == Formulation::axisymmetric && kinematics != Kinematics::small && k % 2 == 0)
      difference(Eigen::seq(0, Eigen::last, 2)).setZero();
    CHECK(difference.cwiseAbs().maxCoeff() < 1e-5 * young);
  }
}

TEST_CASE("the tangent of the multiplicative split is that derivative, hoops and all, and not symmetric") {
  const auto [type, formulation] =
      GENERATE(std::pair{CellType::hexa8, Formulation::solid}, std::pair{CellType::quad8, Formulation::axisymmetric});
  const Flowed body(type, formulation, {Kinematics::multiplicative, Relation::isotropic_linear});
  const Eigen::VectorXd u = body.rough(0.06);
  const Eigen::MatrixXd tangent = full_matrix(body.assembler->stiffness(u), body.assembler->skew_stiffness(u));
  CHECK((tangent - tangent.transpose()).norm() > 1e-4 * tangent.norm());
  CHECK(body.assembler->elastic_skew_stiffness(u).nonZeros() == 0);
  Eigen::MatrixXd derivative(body.dofs->size(), body.dofs->size());
  constexpr double step = 1e-6;
  for (int k = 0; k < body.dofs->size(); ++k) {
    Eigen::VectorXd ahead = u, behind = u;
    ahead[k] += step;
    behind[k] -= step;
    derivative.col(k) = (body.assembler->internal_forces(ahead) - body.assembler->internal_forces(behind)) / (2 * step);
  }
  CHECK((tangent - derivative).cwiseAbs().maxCoeff() < 1e-5 * young);
}

TEST_CASE("stresses and variables written to fields give the forces back and take the body up again") {
  const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::logarithmic);
  Flowed body(CellType::hexa20, Formulation::solid, {kinematics, Relation::mixed_linear});
  const Eigen::VectorXd u = body.rough(0.05);
  const Eigen::VectorXd forces = body.assembler->internal_forces(u);
  const ElementField stresses = body.assembler->stresses(u);
  const ElementField variables = body.assembler->internal_variables(u);
  CHECK(variables.components.size() == (kinematics == Kinematics::small ? 8 : 14));
  CHECK(variables.at(0, 0, 0) > 0.0);
  CHECK(variables.at(0, 0, 1) == 1.0);
  CHECK((body.assembler->forces_of_stresses(u, stresses) - forces).norm() < 1e-12 * forces.norm());

  body.assembler->accept(u);
  const Eigen::VectorXd further = body.rough(0.07);
  const Eigen::VectorXd expected = body.assembler->internal_forces(further);
  Flowed other(CellType::hexa20, Formulation::solid, {kinematics, Relation::mixed_linear});
  other.assembler->resume(u, &stresses, &variables);
  CHECK((other.assembler->internal_forces(further) - expected).norm() < 1e-10 * expected.norm());
}

TEST_CASE("a trial leaves no trace until it is accepted") {
  const Flowed body(CellType::quad4, Formulation::plane_strain, {Kinematics::small, Relation::isotropic_linear});
  const Eigen::VectorXd u = body.rough(0.03);
  const Eigen::VectorXd before = body.assembler->internal_forces(u);
  body.assembler->internal_forces(body.rough(0.5));
  body.assembler->stiffness(body.rough(-0.5));
  CHECK(body.assembler->internal_forces(u) == before);
}

TEST_CASE("where no command variable has changed a step starts with the tangent and the forces of where it is") {
  const auto [type, formulation] = GENERATE(
      std::pair{CellType::hexa8, Formulation::solid}, std::pair{CellType::hexa8, Formulation::solid_reduced},
      std::pair{CellType::tetra10, Formulation::solid_reduced}, std::pair{CellType::tria6, Formulation::plane_stress},
      std::pair{CellType::quad8, Formulation::axisymmetric_reduced});
  const Flowed body(type, formulation, {Kinematics::small, Relation::isotropic_linear});
  const Eigen::VectorXd u = body.rough(0.03);
  const Eigen::VectorXd forces = body.assembler->internal_forces(u);
  CHECK((body.assembler->starting_forces(u) - forces).norm() <= 1e-14 * forces.norm());
  const Eigen::MatrixXd tangent = body.assembler->stiffness(u), starting = body.assembler->starting_stiffness(u);
  CHECK((starting - tangent).norm() <= 1e-14 * tangent.norm());
}

TEST_CASE("a turned body keeps its stresses in its own axes") {
  const Kinematics kinematics = GENERATE(Kinematics::logarithmic, Kinematics::multiplicative);
  Flowed body(CellType::hexa8, Formulation::solid, {kinematics, Relation::isotropic_linear});
  const Mesh& mesh = *body.model.mesh;
  const Eigen::VectorXd u = body.rough(0.03);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  Eigen::VectorXd turned(body.dofs->size());
  for (int node = 0; node < mesh.node_count(); ++node) {
    const Point& at = mesh.nodes[static_cast<std::size_t>(node)];
    const Eigen::Vector3d x(at[0], at[1], at[2]);
    const Eigen::Vector3d own = u.segment<3>(body.dofs->first_dof(node));
    turned.segment<3>(body.dofs->first_dof(node)) = turn * (x + own) - x;
  }
  const Eigen::VectorXd before = body.assembler->internal_forces(u);
  const Eigen::VectorXd after = body.assembler->internal_forces(turned);
  for (int node = 0; node < mesh.node_count(); ++node) {
    const int first = body.dofs->first_dof(node);
    const Eigen::Vector3d expected = turn * before.segment<3>(first);
    CHECK((Eigen::Vector3d(after.segment<3>(first)) - expected).norm() < 1e-10 * before.norm());
  }
}

TEST_CASE("springs, bars, beams and plates that should flow say so") {
  Model model;
  model.mesh = testing::single_cell(CellType::tria3);
  model.formulations = {Formulation::thin_plate};
  MaterialField materials;
  materials.by_cell = {testing::elastic(young, 0.3)};
  const DofMap dofs(model);
  const BehaviourOfCells behaviours = {{Kinematics::small, Relation::isotropic_linear}};
  CHECK_THROWS_WITH(Assembler(model, materials, ElementProperties{}, dofs, &behaviours),
                    Catch::Contains("RELATION") || Catch::Contains("elastic"));
}

}  // namespace inelastic_test
