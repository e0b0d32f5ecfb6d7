#include "solver/elements/slender/slender_forces.hpp"

#include <catch2/catch.hpp>

#include "solver/tests/elements/load_scene.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace slender_forces_test {

constexpr double young = 200.0, poisson = 0.25, length = 2.0;
const BeamSection section{0.5, 0.02, 0.03, 0.01, 1.2, 1.3, 0.0};

/// A cantilever of one element along X, clamped at the origin.
struct Cantilever {
  explicit Cantilever(Formulation formulation, double roll = 0.0)
      : body(mesh(), std::vector{formulation}, elastic(young, poisson), properties(roll)) {}

  static std::shared_ptr<Mesh> mesh() {
    auto result = std::make_shared<Mesh>();
    result->nodes = {{0, 0, 0}, {length, 0, 0}};
    result->add_cell(CellType::seg2, std::array{0, 1});
    return result;
  }
  static ElementProperties properties(double roll) {
    ElementProperties result;
    result.sections[0] = section;
    result.sections[0].roll = roll;
    return result;
  }
  /// Displacements and rotations of the free end.
  Eigen::Matrix<double, 6, 1> tip(BeamForce force) const {
    Load load;
    load.beam_forces.push_back(std::move(force));
    const Eigen::VectorXd forces = body.assembler->external_forces(applied(std::move(load)), 0.0);
    return body.dense_stiffness().bottomRightCorner<6, 6>().ldlt().solve(forces.tail<6>());
  }

  Body body;
};

BeamForce force(int component, double value, BeamAxes axes = BeamAxes::global) {
  BeamForce result{0, axes, {}, {}};
  result.force[component] = value;
  return result;
}

const double shear_modulus = young / (2 * (1 + poisson));

TEST_CASE("a cantilever under a uniform load bends by q L^4 / 8 E I, and shears by q L^2 / 2 G A' (Timoshenko)",
          "[loads]") {
  const double q = 0.7;
  const double l4 = std::pow(length, 4), l3 = std::pow(length, 3), l2 = length * length;
  const auto euler = Cantilever(Formulation::euler_beam).tip(force(1, q));
  CHECK(euler[1] == exactly(q * l4 / (8 * young * section.inertia_z)));
  CHECK(euler[5] == exactly(q * l3 / (6 * young * section.inertia_z)));
  const auto timoshenko = Cantilever(Formulation::timoshenko_beam).tip(force(2, q));
  CHECK(timoshenko[2] == exactly(q * l4 / (8 * young * section.inertia_y) +
                                 q * l2 * section.shear_z / (2 * shear_modulus * section.area)));
  CHECK(timoshenko[4] == exactly(-q * l3 / (6 * young * section.inertia_y)));
  const auto pulled = Cantilever(Formulation::euler_beam).tip(force(0, q));
  CHECK(pulled[0] == exactly(q * l2 / (2 * young * section.area)));
}

TEST_CASE("a load that grows along the cantilever acts by the work that it does on Euler's deflections", "[loads]") {
  BeamForce growing = force(1, 0.0);
  growing.functions[1] = [](const Point& at, double) { return at[0] / length; };  // 1 at the tip
  const double l4 = std::pow(length, 4), l3 = std::pow(length, 3), l2 = length * length;
  const double rigidity = young * section.inertia_z;
  const auto euler = Cantilever(Formulation::euler_beam).tip(growing);
  CHECK(euler[1] == exactly(11.0 * l4 / (120 * rigidity)));
  CHECK(euler[5] == exactly(l3 / (8 * rigidity)));
  // 7/20 of the load's q L goes to the tip, of a constant shear force there; the integral of V / G A' has 1/3 in its
  // place.
  const auto timoshenko = Cantilever(Formulation::timoshenko_beam).tip(growing);
  CHECK(timoshenko[1] ==
        exactly(11.0 * l4 / (120 * rigidity) + 7.0 * l2 / 20.0 * section.shear_y / (shear_modulus * section.area)));
  CHECK(timoshenko[5] == exactly(l3 / (8 * rigidity)));
}

TEST_CASE("a load that grows along a beam that tapers acts at each end as if its value there were constant",
          "[loads]") {
  ElementProperties properties = Cantilever::properties(0.0);
  BeamSection& tapered = properties.sections[0];
  tapered.end = std::make_shared<BeamSection>(section);
  const Body body(Cantilever::mesh(), std::vector{Formulation::timoshenko_beam}, elastic(young, poisson), properties);
  BeamForce growing = force(1, 0.0);
  growing.functions[1] = [](const Point& at, double) { return 3.0 + at[0]; };
  Load load;
  load.beam_forces.push_back(growing);
  const Eigen::VectorXd forces = body.assembler->external_forces(applied(std::move(load)), 0.0);
  CHECK(forces[1] == exactly(3.0 * length / 2));
  CHECK(forces[5] == exactly(3.0 * length * length / 12));
  CHECK(forces[7] == exactly(5.0 * length / 2));
  CHECK(forces[11] == exactly(-5.0 * length * length / 12));
}

TEST_CASE("moments per length twist and bend the cantilever", "[loads]") {
  const double m = 0.3;
  for (const Formulation formulation : {Formulation::euler_beam, Formulation::timoshenko_beam}) {
    const Cantilever beam(formulation);
    CHECK(beam.tip(force(3, m))[3] == exactly(m * length * length / (2 * shear_modulus * section.torsion)));
    const auto bent = beam.tip(force(5, m));
    CHECK(bent[5] == exactly(m * length * length / (2 * young * section.inertia_z)));
    // Moments act as two forces across the beam, which shear it.
    const double shared = formulation == Formulation::euler_beam ? 0.0 : m * length / (shear_modulus * section.area);
    CHECK(bent[1] == exactly(m * std::pow(length, 3) / (3 * young * section.inertia_z) + shared * section.shear_y));
    CHECK(beam.tip(force(4, m))[2] ==
          exactly(-m * std::pow(length, 3) / (3 * young * section.inertia_y) - shared * section.shear_z));
  }
}

TEST_CASE("loads in own axes turn with the roll of the section", "[loads]") {
  const double roll = 0.6;
  const auto turned = Cantilever(Formulation::euler_beam, roll).tip(force(1, 1.0, BeamAxes::own));
  const double along_y = std::pow(length, 4) / (8 * young * section.inertia_z);
  CHECK(turned[1] == exactly(along_y * std::cos(roll)));
  CHECK(turned[2] == exactly(along_y * std::sin(roll)));
}

TEST_CASE("a bar shares its load between its ends, and refuses moments", "[loads]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}, {0, 3, 4}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  ElementProperties properties;
  properties.sections[0] = section;
  const Body body(mesh, std::vector{Formulation::bar}, elastic(young, poisson), properties);
  Load load;
  load.beam_forces.push_back(force(0, 2.0, BeamAxes::own));
  load.beam_forces.back().functions[0] = [](const Point& at, double) { return 1.0 + at[1]; };  // 1, then 4
  const Eigen::VectorXd forces = body.assembler->external_forces(applied(load), 0.0);
  CHECK(forces[1] == exactly(0.6 * 5.0 * (2 * 1 + 4) / 6));
  CHECK(forces[5] == exactly(0.8 * 5.0 * (1 + 2 * 4) / 6));
  load.beam_forces.push_back(force(4, 1.0));
  CHECK_THROWS_WITH(body.assembler->external_forces(applied(load), 0.0),
                    Catch::Contains("M1") && Catch::Contains("bend"));
  const Body solid(single_cell(CellType::hexa8), Formulation::solid, elastic(young, poisson));
  Load misplaced;
  misplaced.beam_forces.push_back(force(0, 1.0));
  CHECK_THROWS_WITH(solid.assembler->external_forces(applied(misplaced), 0.0), Catch::Contains("no bar or beam"));
}

}  // namespace slender_forces_test
