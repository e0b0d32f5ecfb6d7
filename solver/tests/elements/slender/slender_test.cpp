#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/linear/symmetric_eigen.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace slender_test {

const double young = 2e11;
const double poisson = 0.25;
const double shear_modulus = young / 2.5;

/// A chain of segments from the origin along a direction, each of length `step`.
Body chain(const Eigen::Vector3d& direction, double step, int cells, Formulation formulation,
           const BeamSection& section) {
  auto mesh = std::make_shared<Mesh>();
  for (int i = 0; i <= cells; ++i) {
    const Eigen::Vector3d at = i * step * direction.normalized();
    mesh->nodes.push_back({at[0], at[1], at[2]});
    if (i > 0) mesh->add_cell(CellType::seg2, std::array{i - 1, i});
  }
  ElementProperties properties;
  for (int cell = 0; cell < cells; ++cell) properties.sections[cell] = section;
  return Body(mesh, std::vector<Formulation>(cells, formulation), elastic(young, poisson), properties);
}

/// Displacements of a chain clamped at its first node under a force (or moment) vector of six at its last.
Eigen::VectorXd clamped(const Body& body, const Eigen::VectorXd& tip) {
  Eigen::VectorXd force = body.zero();
  force.tail(6) = tip;
  Eigen::VectorXd u = body.zero();
  const auto free = body.dofs->size() - 6;
  u.tail(free) = Eigen::MatrixXd(body.dense_stiffness().bottomRightCorner(free, free))
                     .ldlt()
                     .solve(Eigen::VectorXd(force.tail(free)));
  return u;
}

const BeamSection section{
    .area = 2e-3, .inertia_y = 3e-6, .inertia_z = 5e-6, .torsion = 4e-6, .shear_y = 1.2, .shear_z = 1.5};

TEST_CASE("a bar resists along its axis alone, with E A / L", "[elements]") {
  const Body body = chain({3, 4, 0}, 5.0, 1, Formulation::bar_2d, {.area = 1e-3});
  const Eigen::VectorXd u = Eigen::Vector4d(0, 0, 0.6, 0.8) * 1e-3;
  const double tension = young * 1e-3 / 5.0 * 1e-3;
  CHECK((body.assembler->internal_forces(u) - tension * Eigen::Vector4d(-0.6, -0.8, 0.6, 0.8)).norm() <
        1e-10 * tension);
  CHECK(body.assembler->stresses(u).at(0, 0, 0) == exactly(tension));
  CHECK(body.assembler->internal_forces(Eigen::Vector4d(0, 0, -0.8, 0.6)).norm() < 1e-10 * young * 1e-3 / 5.0);
  CHECK(body.assembler->internal_forces(Eigen::Vector4d(7.1, 3.3, 7.1, 3.3)).norm() == 0.0);
}

TEST_CASE("beams have six motions without energy, in any direction, and none more", "[elements]") {
  for (const auto formulation : {Formulation::euler_beam, Formulation::timoshenko_beam}) {
    for (const Eigen::Vector3d& direction :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 2, -3)}) {
      const Body body = chain(direction, 1.7, 1, formulation, section);
      const Eigen::VectorXd values = symmetric_eigen(body.dense_stiffness()).values;
      CHECK(values.head(6).cwiseAbs().maxCoeff() < 1e-13 * values.maxCoeff());
      CHECK(values[6] > 1e-7 * values.maxCoeff());
      const auto u = body.displacements([](const Point&, int c) { return c < 3 ? 1.0 / 3 + c : 0.0; });
      CHECK(body.assembler->internal_forces(u).norm() == 0.0);
    }
  }
}

TEST_CASE("a cantilever bends by P L^3 / 3 E I, and by shear where the beam knows it", "[elements]") {
  const double length = 2.0;
  const double p = 1e3;
  for (const int cells : {1, 4}) {  // the elements are exact at their nodes
    for (const auto formulation : {Formulation::euler_beam, Formulation::timoshenko_beam}) {
      const Body body = chain({1, 0, 0}, length / cells, cells, formulation, section);
      const double shear =
          formulation == Formulation::timoshenko_beam ? p * length / (shear_modulus * section.area) : 0.0;
      Eigen::VectorXd tip(6);
      tip << p, p, p, p, 0, 0;
      const Eigen::VectorXd u = clamped(body, tip).tail(6);
      const double cube = p * length * length * length / (3 * young);
      CHECK(u[0] == exactly(p * length / (young * section.area)));
      CHECK(u[1] == exactly(cube / section.inertia_z + section.shear_y * shear));
      CHECK(u[2] == exactly(cube / section.inertia_y + section.shear_z * shear));
      CHECK(u[3] == exactly(p * length / (shear_modulus * section.torsion)));
      CHECK(u[4] == exactly(-p * length * length / (2 * young * section.inertia_y)));
      CHECK(u[5] == exactly(p * length * length / (2 * young * section.inertia_z)));
    }
  }
}

TEST_CASE("section forces of a cantilever: constant shear, linear moment, zero at the tip", "[elements]") {
  const Body body = chain({1, 0, 0}, 1.0, 2, Formulation::euler_beam, section);
  Eigen::VectorXd tip(6);
  tip << 7.0, 5.0, 0, 0, 0, 0;
  const ElementField force = body.assembler->stresses(clamped(body, tip));
  const int n = force.component("N");
  const int shear = force.component("VY");
  const int moment = force.component("MFZ");
  CHECK(force.at(0, 0, n) == exactly(7.0));
  CHECK(force.at(1, 2, n) == exactly(7.0));
  CHECK(force.at(0, 0, shear) == exactly(5.0));
  CHECK(force.at(0, 0, moment) == exactly(10.0));
  CHECK(force.at(0, 1, moment) == exactly(7.5));
  CHECK(force.at(0, 2, moment) == exactly(5.0));
  CHECK(force.at(1, 2, moment) == Approx(0.0).margin(1e-6));
}

TEST_CASE("a roll of 90 degrees swaps the two bending planes", "[elements]") {
  BeamSection rolled = section;
  rolled.roll = std::acos(0.0);
  std::swap(rolled.inertia_y, rolled.inertia_z);
  std::swap(rolled.shear_y, rolled.shear_z);
  const Eigen::MatrixXd a = chain({1, 1, 2}, 1.0, 1, Formulation::timoshenko_beam, section).dense_stiffness();
  const Eigen::MatrixXd b = chain({1, 1, 2}, 1.0, 1, Formulation::timoshenko_beam, rolled).dense_stiffness();
  CHECK((a - b).cwiseAbs().maxCoeff() < 1e-14 * a.cwiseAbs().maxCoeff());
}

TEST_CASE("the parts of a beam's energy add up to the whole, each by the force that works for it", "[elements]") {
  BeamSection channel = section;
  channel.centre_y = 0.02;
  channel.centre_z = -0.03;
  const double length = 2.0, force = 300.0, twist = 50.0;
  const Body body = chain({1, 2, 2}, length, 1, Formulation::timoshenko_beam, channel);
  const Eigen::Matrix3d axes = own_axes(*body.model.mesh, 0, 0.0);
  const auto parts_under = [&](const Eigen::Vector3d& own_force, const Eigen::Vector3d& own_moment) {
    Eigen::VectorXd tip(6);
    tip << axes.transpose() * own_force, axes.transpose() * own_moment;
    const ElementField energies = body.assembler->elastic_energies(clamped(body, tip));
    CHECK(energies.components == std::vector<std::string>{"TOTALE", "TRAC_COM", "TORSION", "FLEX_Y", "FLEX_Z"});
    Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(energies.values.data(), 5);
    CHECK(values.tail(4).sum() == exactly(values[0]));
    return values;
  };
  const Eigen::VectorXd twisted = parts_under({0, 0, 0}, {twist, 0, 0});
  CHECK(twisted[2] == Approx(twist * twist * length / (2 * shear_modulus * channel.torsion)).epsilon(1e-11));
  CHECK(twisted[2] == exactly(twisted[0]));
  // A force through the centroid twists it as well, by its lever about the centre of torsion.
  const double lever = channel.centre_z * force;
  const Eigen::VectorXd bent = parts_under({0, force, 0}, {0, 0, 0});
  CHECK(bent[2] == Approx(lever * lever * length / (2 * shear_modulus * channel.torsion)).epsilon(1e-11));
  const double own = std::pow(length, 3) / (6 * young * channel.inertia_z) +
                     channel.shear_y * length / (2 * shear_modulus * channel.area);
  CHECK(bent[4] == Approx(force * force * own).epsilon(1e-11));
  CHECK(std::abs(bent[1]) + std::abs(bent[3]) < 1e-11 * bent[0]);
}

TEST_CASE("a bar without a cross-section is named", "[elements]") {
  CHECK_THROWS_WITH(chain({1, 0, 0}, 1.0, 1, Formulation::bar, {}), Catch::Contains("M1") && Catch::Contains("area"));
}

TEST_CASE("a force through the centre of torsion bends a beam without twisting it", "[elements]") {
  BeamSection channel = section;
  channel.centre_y = 0.02;
  channel.centre_z = -0.03;
  const Body eccentric = chain({1, 0, 0}, 1.0, 2, Formulation::timoshenko_beam, channel);
  const Body centred = chain({1, 0, 0}, 1.0, 2, Formulation::timoshenko_beam, section);
  const double fy = 700.0;
  const double fz = 500.0;
  Eigen::VectorXd tip(6);
  tip << 0, fy, fz, channel.centre_y * fz - channel.centre_z * fy, 0, 0;  // moved to the centroid
  const Eigen::VectorXd u = clamped(eccentric, tip).tail(6);
  tip[3] = 0.0;
  const Eigen::VectorXd expected = clamped(centred, tip).tail(6);
  CHECK(std::abs(u[3]) < 1e-12 * std::abs(u[5]));
  CHECK((u - expected).norm() < 1e-10 * expected.norm());
}

}  // namespace slender_test
