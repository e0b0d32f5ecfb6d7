#include "solver/elements/slender/varying_section.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "solver/elements/slender/section_shapes.hpp"
#include "solver/error.hpp"
#include "solver/linear/symmetric_eigen.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace varying_section_test {

constexpr double young = 2e11;
constexpr double poisson = 0.25;
constexpr double shear_modulus = young / 2.5;
constexpr double length = 3.0;

/// A cantilever of `cells` beams from the origin along (1, 2, 2), cut out of one cone that ends in `tip` of its first
/// radius.
Body cone(double radius, double tip, int cells, Formulation formulation) {
  auto mesh = std::make_shared<Mesh>();
  ElementProperties properties;
  const auto disc = [&](double s) {
    const double r = radius * (1.0 + s * (tip - 1.0));
    return circular_section(r, r);
  };
  for (int i = 0; i <= cells; ++i) {
    const double at = length * i / cells;
    mesh->nodes.push_back({at / 3, 2 * at / 3, 2 * at / 3});
    if (i == 0) continue;
    mesh->add_cell(CellType::seg2, std::array{i - 1, i});
    properties.sections[i - 1] =
        varying_section(disc((i - 1.0) / cells), disc(static_cast<double>(i) / cells), all_sizes_vary);
  }
  return Body(mesh, std::vector<Formulation>(cells, formulation), elastic(young, poisson), properties);
}

/// Displacement of the free end, in own axes, under a force and a moment there.
Eigen::VectorXd tip_displacement(const Body& body, const Eigen::Matrix<double, 6, 1>& load) {
  const Eigen::Matrix3d axes = own_axes(*body.model.mesh, 0);
  const auto free = body.dofs->size() - 6;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(free);
  force.segment<3>(free - 6) = axes.transpose() * load.head<3>();
  force.tail<3>() = axes.transpose() * load.tail<3>();
  const Eigen::VectorXd u = Eigen::MatrixXd(body.dense_stiffness().bottomRightCorner(free, free)).ldlt().solve(force);
  Eigen::VectorXd own(6);
  own << axes * u.segment<3>(free - 6), axes * u.tail<3>();
  return own;
}

TEST_CASE("a cone is one beam: pulled, twisted and bent at its end it moves as theory says", "[elements]") {
  const double r = 0.1;
  const double tip = GENERATE(0.5, 0.999999, 2.0, 0.05);
  CAPTURE(tip);
  const Body body = cone(r, tip, 1, Formulation::euler_beam);
  const double area = std::numbers::pi * r * r;
  const double inertia = area * r * r / 4.0;
  Eigen::Matrix<double, 6, 1> load = Eigen::Matrix<double, 6, 1>::Zero();
  load << 5e3, 7e3, 0, 11e3, 0, 0;
  const Eigen::VectorXd u = tip_displacement(body, load);
  CHECK(u[0] == exactly(5e3 * length / (young * area * tip)));
  // Integrals of s^-4 and of s^2 times it along the cone (R. J. Roark, Formulas for Stress and Strain, tapered beams).
  CHECK(u[3] == exactly(11e3 * length / (shear_modulus * 2 * inertia) * (1 + 1 / tip + 1 / (tip * tip)) / (3 * tip)));
  CHECK(u[1] == exactly(7e3 * length * length * length / (3 * young * inertia * tip)));
}

TEST_CASE("a cone is the same beam whether cut into pieces or not", "[elements]") {
  const auto formulation = GENERATE(Formulation::euler_beam, Formulation::timoshenko_beam);
  Eigen::Matrix<double, 6, 1> load;
  load << 5e3, 7e3, -2e3, 11e3, 3e3, 1e3;
  const Eigen::VectorXd whole = tip_displacement(cone(0.3, 0.4, 1, formulation), load);
  const Eigen::VectorXd cut = tip_displacement(cone(0.3, 0.4, 5, formulation), load);
  for (int i = 0; i < 6; ++i) CHECK(cut[i] == Approx(whole[i]).epsilon(1e-10));
}

TEST_CASE("shear adds its own flexibility to that of bending", "[elements]") {
  Eigen::Matrix<double, 6, 1> load = Eigen::Matrix<double, 6, 1>::Zero();
  load[1] = 7e3;
  const double bent = tip_displacement(cone(0.3, 0.4, 1, Formulation::euler_beam), load)[1];
  const double sheared = tip_displacement(cone(0.3, 0.4, 1, Formulation::timoshenko_beam), load)[1];
  const double area = std::numbers::pi * 0.3 * 0.3;
  const double factor = circular_section(0.3, 0.3).shear_y;
  CHECK(sheared - bent == Approx(7e3 * length * factor / (shear_modulus * area * 0.4)).epsilon(1e-9));
}

TEST_CASE("a section that varies not at all is a uniform one", "[elements]") {
  const auto formulation = GENERATE(Formulation::euler_beam, Formulation::timoshenko_beam);
  const BeamSection section = rectangular_section({0.2, 0.1, 0.0, 0.0});
  const auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}, {1, 2, 2}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  ElementProperties uniform, varying;
  uniform.sections[0] = section;
  varying.sections[0] = varying_section(section, section, one_size_varies);
  const Eigen::MatrixXd a = Body(mesh, {formulation}, elastic(young, poisson), uniform).dense_stiffness();
  const Eigen::MatrixXd b = Body(mesh, {formulation}, elastic(young, poisson), varying).dense_stiffness();
  CHECK((a - b).norm() < 1e-12 * a.norm());
}

TEST_CASE("a varying beam has six motions without energy and none more", "[elements]") {
  const Body body = cone(0.2, 0.3, 1, Formulation::timoshenko_beam);
  const Eigen::VectorXd values = symmetric_eigen(body.dense_stiffness()).values;
  CHECK(values.head(6).cwiseAbs().maxCoeff() < 1e-13 * values.maxCoeff());
  CHECK(values[6] > 1e-6 * values.maxCoeff());
}

TEST_CASE("the section halfway along a tapered rectangle lies between those of its ends", "[elements]") {
  const BeamSection first = rectangular_section({0.05, 0.1, 0.0, 0.0});
  const BeamSection last = rectangular_section({0.05, 0.2, 0.0, 0.0});
  const BeamSection section = varying_section(first, last, one_size_varies);
  CHECK(section_at(section, 0.0).inertia_y == exactly(first.inertia_y));
  CHECK(section_at(section, 1.0).inertia_y == exactly(last.inertia_y));
  const BeamSection middle = section_at(section, 0.5);
  const BeamSection exact = rectangular_section({0.05, 0.15, 0.0, 0.0});
  CHECK(middle.area == exactly(exact.area));
  CHECK(middle.reach_z == exactly(exact.reach_z));
  CHECK(middle.shear_y == exactly(1.2));
  CHECK_THROWS_AS(varying_section({.area = 1.0, .centre_y = 0.1}, {.area = 1.0, .centre_y = 0.2}, all_sizes_vary),
                  Error);
}

TEST_CASE("a cone weighs a third of base times height, and all of it reaches the nodes", "[elements]") {
  const double r = 0.1;
  const double tip = 0.5;
  const Body body = cone(r, tip, 2, Formulation::euler_beam);
  Material heavy;
  heavy.elasticity = IsotropicElasticity{.young = young, .poisson = poisson, .density = 7800.0};
  MaterialField materials;
  materials.by_cell.assign(2, std::make_shared<const Material>(heavy));
  const Assembler assembler(body.model, materials, body.properties, *body.dofs);
  auto load = std::make_shared<Load>();
  load->gravities.push_back({{0, 1}, {0.0, 0.0, -10.0}});
  const std::vector<AppliedLoad> loads = {{load, {}}};
  const Eigen::VectorXd forces = assembler.external_forces(loads, 0.0);
  double weight = 0.0;
  for (int node = 0; node < 3; ++node) weight += forces[body.dofs->dof(node, Component::dz)];
  const double volume = std::numbers::pi * r * r * length * (1 + tip + tip * tip) / 3.0;
  CHECK(weight == exactly(-78000.0 * volume));
}

}  // namespace varying_section_test
