#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/elements/sample_meshes.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

const BehaviourOfCells touching = {{Kinematics::small, Relation::contact_spring}};

std::shared_ptr<const Material> contact_material() {
  Material material;
  material.contact_spring =
      ContactSpring{.normal = 10.0, .tangential = 4.0, .friction = 0.3, .first_distance = 2.0, .second_distance = 0.9};
  return std::make_shared<const Material>(material);
}

/// From the origin to (1, 2, 2), of length 3: a gap of 0.1.
Body segment(Formulation formulation, double stiffness = 0.0) {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 3;
  mesh->nodes = {{0, 0, 0}, {1, 2, 2}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  ElementProperties properties;
  const std::vector<double> values(static_cast<std::size_t>(discrete_components(formulation)), stiffness);
  properties.discrete[0] = diagonal_stiffness(*mesh, 0, formulation, values, DiscreteFrame::local);
  return Body(mesh, std::vector<Formulation>{formulation}, contact_material(), properties);
}

}  // namespace

TEST_CASE("a segment with contact pushes its nodes apart along itself, and moments are those of its stiffness",
          "[elements]") {
  const Body body = segment(Formulation::spring_rotation_3d, 7.0);
  Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &touching);
  const Eigen::Vector3d along(1.0 / 3, 2.0 / 3, 2.0 / 3);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(12);
  u.segment<3>(6) = -0.3 * along;
  u[9] = 0.5;
  const Eigen::VectorXd forces = assembler.internal_forces(u);
  CHECK((forces.segment<3>(6) + 10.0 * 0.2 * along).norm() <= 1e-12);
  CHECK((forces.head<3>() + forces.segment<3>(6)).norm() <= 1e-12);
  CHECK((forces.tail<3>() - Eigen::Vector3d(3.5, 0, 0)).norm() <= 1e-12);
  // Apart, nothing of the translations' stiffness is left.
  u.segment<3>(6) = 0.3 * along;
  CHECK(assembler.internal_forces(u).segment<3>(6).norm() <= 1e-12);
}

TEST_CASE("the tangent of a segment with contact is the derivative of its forces", "[elements]") {
  const Body body = segment(Formulation::spring_3d);
  Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &touching);
  Eigen::VectorXd u(6);
  u << 0.01, 0.02, 0, -0.3, -0.5, 0.1;
  CHECK_FALSE(assembler.is_symmetric());
  const Eigen::MatrixXd tangent = full_matrix(assembler.stiffness(u), assembler.skew_stiffness(u));
  constexpr double h = 1e-6;
  for (int k = 0; k < 6; ++k) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(6, k);
    const Eigen::VectorXd column =
        (assembler.internal_forces(u + step) - assembler.internal_forces(u - step)) / (2 * h);
    CHECK((column - tangent.col(k)).norm() <= 1e-7);
  }
}

TEST_CASE("a segment with contact goes on from its force and its variables as if it had never stopped", "[elements]") {
  const Body body = segment(Formulation::spring_3d);
  Eigen::VectorXd u(6), later(6);
  u << 0, 0, 0, -0.3, -0.5, 0.1;
  later << 0, 0, 0, -0.25, -0.4, 0.0;
  Assembler whole(body.model, body.materials, body.properties, *body.dofs, &touching);
  whole.accept(u);
  const ElementField stresses = whole.stresses(u), variables = whole.internal_variables(u);
  for (const ElementField* given : {&variables, static_cast<const ElementField*>(nullptr)}) {
    Assembler resumed(body.model, body.materials, body.properties, *body.dofs, &touching);
    resumed.resume(u, &stresses, given);
    CHECK((resumed.internal_forces(later) - whole.internal_forces(later)).norm() <= 1e-12);
  }
  CHECK((whole.forces_of_stresses(u, stresses) - whole.internal_forces(u)).norm() <= 1e-12);
}

TEST_CASE("contact is a law of discrete elements that have a contact spring", "[elements]") {
  Body body = segment(Formulation::spring_3d);
  body.materials.by_cell[0] = elastic(1.0, 0.0);
  CHECK_THROWS_WITH(Assembler(body.model, body.materials, body.properties, *body.dofs, &touching),
                    Catch::Contains("no contact spring"));
  Body coupled = segment(Formulation::spring_rotation_3d);
  coupled.properties.discrete[0].matrix(0, 3) = coupled.properties.discrete[0].matrix(3, 0) = 1.0;
  CHECK_THROWS_WITH(Assembler(coupled.model, coupled.materials, coupled.properties, *coupled.dofs, &touching),
                    Catch::Contains("couples"));
}
