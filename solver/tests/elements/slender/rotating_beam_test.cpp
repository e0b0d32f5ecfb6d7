#include "solver/elements/slender/rotating_beam.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/elements/sample_meshes.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

const BehaviourOfCells turning = {{Kinematics::large_rotations, Relation::elastic}};

/// One beam from the origin to (1, 2, 2), of length 3.
Body beam(Formulation formulation) {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 3;
  mesh->nodes = {{0, 0, 0}, {1, 2, 2}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  ElementProperties properties;
  properties.sections[0] = {
      .area = 2.0, .inertia_y = 0.5, .inertia_z = 0.8, .torsion = 0.6, .shear_y = 1.2, .shear_z = 1.1, .roll = 0.3};
  return Body(mesh, std::vector<Formulation>{formulation}, elastic(100.0, 0.25), properties);
}

Eigen::VectorXd bent(double size) {
  Eigen::VectorXd u(12);
  u << 0.1, -0.2, 0.05, 0.3, 0.1, -0.2, 0.25, 0.1, 0.4, -0.1, 0.35, 0.2;
  return size * u;
}

}  // namespace

TEST_CASE("the tangent of a beam in large rotations is the derivative of its forces", "[elements]") {
  for (const Formulation formulation : {Formulation::euler_beam, Formulation::timoshenko_beam}) {
    const Body body = beam(formulation);
    Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &turning);
    assembler.accept(bent(0.7));
    const Eigen::VectorXd u = bent(1.0) + 0.1 * Eigen::VectorXd::LinSpaced(12, -1.0, 1.5);
    const Eigen::MatrixXd tangent = full_matrix(assembler.stiffness(u), assembler.skew_stiffness(u));
    constexpr double h = 1e-6;
    for (int k = 0; k < 12; ++k) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(12, k);
      const Eigen::VectorXd column =
          (assembler.internal_forces(u + step) - assembler.internal_forces(u - step)) / (2 * h);
      CHECK((column - tangent.col(k)).norm() <= 1e-7 * tangent.norm());
    }
  }
}

/// The rows and columns of the second node, the first one held, after two steps: from corrections under six loads.
TEST_CASE("the symmetric tangent of a beam in large rotations is that of Code_Aster 17.3", "[elements]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->dimension = 3;
  mesh->nodes = {{0, 0, 0}, {2, 1, 0.5}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  ElementProperties properties;
  properties.sections[0] = {
      .area = 0.02, .inertia_y = 3e-5, .inertia_z = 7e-5, .torsion = 2e-5, .shear_y = 1.2, .shear_z = 1.3};
  const Body body(mesh, std::vector<Formulation>{Formulation::timoshenko_beam}, elastic(71240.0, 0.3), properties);
  Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &turning);
  Eigen::VectorXd first = body.zero(), second = body.zero();
  first.tail<6>() << 0.011, -0.004, 0.013, 0.02, -0.03, 0.05;
  second.tail<6>() << 0.021, 0.004, -0.013, -0.05, -0.04, 0.07;
  assembler.accept(first);
  const SymmetricMatrix lower = assembler.symmetric_stiffness(second);
  const Eigen::MatrixXd tangent = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
  Eigen::Matrix<double, 6, 6> expected;
  expected << 4.75297051e+02, 2.30977404e+02, 1.12579095e+02, -2.32244850e-01, -8.11272592e-01, 2.85000779e+00,  //
      2.30977404e+02, 1.25129470e+02, 5.58611989e+01, 1.33546993e+00, 2.30350198e-01, -5.73783710e+00,           //
      1.12579095e+02, 5.58611989e+01, 3.48158138e+01, -1.78941471e+00, 2.89180762e+00, 1.89465161e-03,           //
      -2.32244850e-01, 1.33546993e+00, -1.78941471e+00, 2.17309363e+00, -2.60184191e+00, -2.17719234e+00,        //
      -8.11272592e-01, 2.30350198e-01, 2.89180762e+00, -2.60184191e+00, 5.61757033e+00, -1.00535339e+00,         //
      2.85000779e+00, -5.73783710e+00, 1.89465147e-03, -2.17719234e+00, -1.00535339e+00, 1.12967855e+01;
  CHECK((tangent.bottomRightCorner<6, 6>() - expected).cwiseAbs().maxCoeff() <= 1e-6);
}

TEST_CASE("a beam in large rotations begins as the linear one", "[elements]") {
  const Body body = beam(Formulation::timoshenko_beam);
  const Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &turning);
  const Eigen::MatrixXd tangent = full_matrix(assembler.stiffness(body.zero()), assembler.skew_stiffness(body.zero()));
  const Eigen::MatrixXd linear = body.dense_stiffness();
  CHECK((tangent - linear).norm() <= 1e-12 * linear.norm());
}

TEST_CASE("the axes of a beam turn with it, and its forces with them", "[elements]") {
  const Body body = beam(Formulation::euler_beam);
  Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &turning);
  assembler.accept(bent(0.01));
  const ElementField before = assembler.stresses(bent(0.01));
  // A quarter turn in steps so small that what they leave counts no more.
  const Eigen::Vector3d chord = Eigen::Vector3d(1, 2, 2) + bent(0.01).segment<3>(6) - bent(0.01).head<3>();
  const Eigen::Vector3d axis = chord.cross(Eigen::Vector3d(0.4, 1.0, -0.3)).normalized();
  constexpr int steps = 4000;
  Eigen::VectorXd u = bent(0.01);
  for (int k = 1; k <= steps; ++k) {
    const double angle = 0.5 * std::numbers::pi * k / steps;
    const Eigen::Vector3d now = Eigen::AngleAxisd(angle, axis) * chord;
    u.segment<3>(6) = bent(0.01).segment<3>(6) + now - chord;
    for (const int node : {0, 6}) u.segment<3>(node + 3) = bent(0.01).segment<3>(node + 3) + angle * axis;
    assembler.accept(u);
  }
  const ElementField after = assembler.stresses(u);
  // Each step leaves half the square of its turn as an elongation: 3e-4 in all, of E A = 200.
  for (std::size_t k = 0; k < after.values.size(); ++k) CHECK(std::abs(after.values[k] - before.values[k]) <= 0.1);
  const Eigen::VectorXd turned = assembler.forces_of_stresses(u, before);
  Assembler still(body.model, body.materials, body.properties, *body.dofs, &turning);
  still.accept(bent(0.01));
  const Eigen::VectorXd first = still.forces_of_stresses(bent(0.01), before);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5 * std::numbers::pi, axis).toRotationMatrix();
  for (int part = 0; part < 12; part += 3)
    CHECK((turned.segment<3>(part) - turn * first.segment<3>(part)).norm() <= 1e-3 * first.norm());
}

/// Of a step from rest: the axes go with the chord, the second axis staying in the plane of the old one and the chord,
/// and turn about it by the mean of the rotations of both ends.
TEST_CASE("the axes of a beam turn about its chord by the rotations of its ends, as in Code_Aster 17.3", "[elements]") {
  const Body body = beam(Formulation::euler_beam);
  Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &turning);
  const double before = assembler.internal_variables(body.zero()).at(0, 0, 1);
  Eigen::VectorXd u = body.zero();
  u.segment<3>(9) = 0.3 * Eigen::Vector3d(1, 2, 2).normalized();
  CHECK(assembler.internal_variables(u).at(0, 0, 1) == Approx(before + 0.15).margin(1e-14));
  // Whole rotations count, step after step.
  assembler.accept(u);
  CHECK(assembler.internal_variables(2.0 * u).at(0, 0, 1) == Approx(before + 0.3).margin(1e-14));
}

TEST_CASE("a beam in large rotations goes on from its forces and variables as if it had never stopped", "[elements]") {
  const Body body = beam(Formulation::euler_beam);
  Assembler whole(body.model, body.materials, body.properties, *body.dofs, &turning);
  whole.accept(bent(0.5));
  whole.accept(bent(1.0));
  const ElementField stresses = whole.stresses(bent(1.0)), variables = whole.internal_variables(bent(1.0));
  Assembler resumed(body.model, body.materials, body.properties, *body.dofs, &turning);
  resumed.resume(bent(1.0), &stresses, &variables);
  const Eigen::VectorXd expected = whole.internal_forces(bent(1.3));
  CHECK((resumed.internal_forces(bent(1.3)) - expected).norm() <= 1e-12 * expected.norm());
}

TEST_CASE("ELASTIQUE of a beam in large rotations is that of small ones, wherever it has gone", "[elements]") {
  for (const Formulation formulation : {Formulation::euler_beam, Formulation::timoshenko_beam}) {
    const Body body = beam(formulation);
    const Eigen::MatrixXd expected = body.assembler->stiffness(Eigen::VectorXd::Zero(12));
    Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &turning);
    assembler.accept(bent(0.7));
    const Eigen::MatrixXd found = assembler.initial_stiffness(bent(1.0));
    CHECK((found - expected).norm() < 1e-12 * expected.norm());
    CHECK(assembler.initial_skew_stiffness(bent(1.0)).norm() == 0.0);
  }
}
