#include "solver/elements/geometric_stiffness.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "sample_meshes.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

const BeamSection section{
    .area = 2.0, .inertia_y = 0.5, .inertia_z = 0.8, .torsion = 0.6, .shear_y = 1.2, .shear_z = 1.1};

}  // namespace

TEST_CASE("an axial force turns a beam as it turns a bar", "[elements]") {
  constexpr double length = 3.0, n = 7.0;
  const BeamMatrix k = beam_geometric_stiffness(section, length, {{{.n = n}, {.n = n}}});
  CHECK((k - k.transpose()).norm() <= 1e-14 * k.norm());
  // Turned by an angle about z, rotations with it: both ends are pulled aside by N times the angle, and no moment is
  // left.
  Eigen::Matrix<double, 12, 1> turn = Eigen::Matrix<double, 12, 1>::Zero();
  turn[5] = turn[11] = 1.0;
  turn[7] = length;
  Eigen::Matrix<double, 12, 1> expected = Eigen::Matrix<double, 12, 1>::Zero();
  expected[1] = -n;
  expected[7] = n;
  CHECK((k * turn - expected).norm() <= 1e-12);
}

TEST_CASE("section forces in balance that turn with a beam stay the same in its own axes", "[elements]") {
  // Moments at the ends with the shear forces that balance them.
  constexpr double length = 3.0, my = 2.0, my_end = -1.0, mz = 0.5, mz_end = 1.5;
  const double vz = (my_end - my) / length, vy = -(mz_end - mz) / length;
  const SectionForces first{.n = 4.0, .vy = vy, .vz = vz, .mfy = my, .mfz = mz},
      second{.n = 4.0, .vy = vy, .vz = vz, .mfy = my_end, .mfz = mz_end};
  const BeamMatrix k = beam_geometric_stiffness(section, length, {first, second});
  Eigen::Matrix<double, 12, 1> force;
  force << -4.0, -vy, -vz, 0, -my, -mz, 4.0, vy, vz, 0, my_end, mz_end;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d w = Eigen::Vector3d::Unit(axis);
    Eigen::Matrix<double, 12, 1> turn, expected;
    turn << Eigen::Vector3d::Zero(), w, w.cross(Eigen::Vector3d(length, 0, 0)), w;
    // Semitangential moments turn by half the angle.
    for (int part = 0; part < 12; part += 3)
      expected.segment<3>(part) = (part % 6 == 0 ? 1.0 : 0.5) * w.cross(force.segment<3>(part));
    const Eigen::Matrix<double, 12, 1> change = k * turn;
    INFO("axis " << axis);
    for (int i = 0; i < 12; ++i)
      if (i % 6 != 0) CHECK(std::abs(change[i] - expected[i]) <= 1e-12);
  }
}

TEST_CASE("a stretched continuum resists turning by its stress", "[elements]") {
  // Tetrahedra on ten nodes have a point of negative weight.
  for (const CellType type :
       {CellType::quad4, CellType::tria6, CellType::tetra10, CellType::hexa20, CellType::penta15, CellType::pyram13}) {
    INFO(name_of(type));
    const Formulation formulation = dimension(type) == 3 ? Formulation::solid : Formulation::plane_strain;
    const Body body(single_cell(type), formulation, elastic(10.0, 0.0));
    const Eigen::VectorXd u =
        body.displacements([](const Point& at, int component) { return component == 0 ? 1e-3 * at[0] : 0.0; });
    const SymmetricMatrix lower = body.assembler->geometric_stiffness(u);
    const Eigen::MatrixXd k = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
    const Eigen::VectorXd aside =
        body.displacements([](const Point& at, int component) { return component == 1 ? at[0] : 0.0; });
    const Eigen::VectorXd across =
        body.displacements([](const Point& at, int component) { return component == 0 ? at[1] : 0.0; });
    // The stress is 1e-2 along x alone; the volume is what a unit strain energy of E = 2 measures.
    const Body unit(single_cell(type), formulation, elastic(2.0, 0.0));
    const Eigen::VectorXd stretch =
        unit.displacements([](const Point& at, int component) { return component == 0 ? at[0] : 0.0; });
    const double area = 0.5 * stretch.dot(unit.dense_stiffness() * stretch);
    CHECK(aside.dot(k * aside) == Approx(1e-2 * area).epsilon(1e-12));
    CHECK(std::abs(across.dot(k * across)) <= 1e-12 * area);
  }
}

TEST_CASE("strains that loads impose add no stress to the stiffness", "[elements]") {
  const Body body(single_cell(CellType::hexa8), Formulation::solid, elastic(10.0, 0.3));
  Load load;
  load.initial_strains.push_back({0, {1e-3, 0, 0, 0, 0, 0}, {}});
  const std::vector<AppliedLoad> loads = {{std::make_shared<const Load>(load), {}}};
  const Eigen::VectorXd free =
      body.displacements([](const Point& at, int component) { return component == 0 ? 1e-3 * at[0] : 0.0; });
  const double without = SymmetricMatrix(body.assembler->geometric_stiffness(free)).norm();
  body.assembler->impose_strains(loads, 0.0);
  CHECK(body.assembler->geometric_stiffness(free).norm() <= 1e-13 * without);
}
