#include "solver/elements/solids/imposed_strains.hpp"

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/fields/integrals/energies.hpp"
#include "solver/tests/elements/load_scene.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

constexpr std::array<double, 6> strain = {1e-3, -2e-3, 5e-4, 3e-4, -4e-4, 7e-4};

/// The displacement whose gradient is the strain, in space or in the plane.
double stretched(const Point& x, int c, int dimension) {
  const Eigen::Matrix3d e = (Eigen::Matrix3d() << strain[0], strain[3], strain[4], strain[3], strain[1], strain[5],  //
                             strain[4], strain[5], strain[2])
                                .finished();
  Eigen::Vector3d at(x.data());
  if (dimension == 2) at[2] = 0.0;
  return (e * at)[c];
}

/// What a body of this dimension knows of it.
std::array<double, 6> strain_of(int dimension) {
  std::array<double, 6> known = strain;
  if (dimension == 2) known[4] = known[5] = 0.0;
  return known;
}

double largest_stress(const ElementField& field) {
  double largest = 0.0;
  for (const double value : field.values) largest = std::max(largest, std::isnan(value) ? 0.0 : std::abs(value));
  return largest;
}

}  // namespace

TEST_CASE("a free body takes an initial strain without stress, on every cell", "[loads]") {
  std::vector<CellType> types(std::begin(plane_types), std::end(plane_types));
  types.insert(types.end(), std::begin(solid_types), std::end(solid_types));
  for (const CellType type : types) {
    CAPTURE(name_of(type));
    const int d = dimension(type);
    const Body body(single_cell(type, 0.04), d == 3 ? Formulation::solid : Formulation::plane_stress,
                    elastic(100.0, 0.3));
    Load load;
    load.initial_strains.push_back({0, strain_of(d), {}});
    load.initial_strains.back().strain[0] = 99.0;
    load.initial_strains.back().functions[0] = [](const Point&, double t) { return strain[0] * t / 2.0; };
    auto both = applied(load, [](double t) { return 1.0 / t; });  // two halves at t = 2
    both.push_back(both.front());
    const Eigen::VectorXd u = body.displacements([&](const Point& x, int c) { return stretched(x, c, d); });
    const Eigen::VectorXd forces = body.assembler->external_forces(both, 2.0);
    CHECK((body.assembler->internal_forces(u) - forces).norm() < 1e-13);
    CHECK((body.assembler->initial_strain_forces(both, 2.0) - forces).norm() == 0.0);
    CHECK(largest_stress(body.assembler->stresses(u, both, 2.0)) < 1e-13);
    CHECK(largest_stress(body.assembler->stresses(u)) > 1e-2);
    // No energy where there is no stress; held back, that of the stress on the strain that is not there.
    body.assembler->impose_strains(both, 2.0);
    const ElementField held = body.assembler->stresses(body.zero(), both, 2.0);
    const std::array<double, 6> shown = strain_of(d);
    double density = 0.0;
    for (int c = 0; c < (d == 3 ? 6 : 4); ++c) density -= (c < 3 ? 0.5 : 1.0) * held.at(0, 0, c) * shown[c];
    const double energy = density * cell_volumes(body.model).values[0];
    CHECK(std::abs(body.assembler->elastic_energies(u).values[0]) <= 1e-13 * energy);
    CHECK(body.assembler->elastic_energies(body.zero()).values[0] == Approx(energy).epsilon(1e-12));
  }
}

TEST_CASE("a held body answers an initial strain by minus Hooke's law times it", "[loads]") {
  const Body body(single_cell(CellType::quad4), Formulation::plane_strain, elastic(100.0, 0.25));
  Load load;
  load.initial_strains.push_back({0, {1e-3, 1e-3, 1e-3, 0, 0, 0}, {}});
  const ElementField field = body.assembler->stresses(body.zero(), applied(load), 0.0);
  for (const int c : {0, 1, 2}) CHECK(field.at(0, 0, c) == exactly(-100.0 * 1e-3 / (1 - 2 * 0.25)));
  CHECK(field.at(0, 0, 3) == Approx(0.0).margin(1e-15));
}

TEST_CASE("bars and beams take elongation and curvature without section forces", "[loads]") {
  for (const Formulation formulation :
       {Formulation::bar, Formulation::bar_2d, Formulation::euler_beam, Formulation::timoshenko_beam}) {
    const bool beam = formulation == Formulation::euler_beam || formulation == Formulation::timoshenko_beam;
    auto mesh = std::make_shared<Mesh>();
    mesh->dimension = formulation == Formulation::bar_2d ? 2 : 3;
    mesh->nodes = {{0, 0, 0}, {0, 2, 0}};
    mesh->add_cell(CellType::seg2, std::array{0, 1});
    ElementProperties properties;
    properties.sections[0] = {.area = 0.5,
                              .inertia_y = 0.02,
                              .inertia_z = 0.03,
                              .torsion = 0.01,
                              .shear_y = 1.2,
                              .shear_z = 1.3,
                              .roll = 0.3};
    Body body(mesh, std::vector{formulation}, elastic(100.0, 0.25), properties);
    const double elongation = 1e-3, curvature_y = beam ? 2e-3 : 0.0, curvature_z = beam ? -3e-3 : 0.0;
    Load load;
    load.initial_slender_strains.push_back({0, {elongation, curvature_y, curvature_z}, {}});
    Eigen::VectorXd u = body.zero();
    const Eigen::Matrix3d axes = own_axes(*mesh, 0, beam ? 0.3 : 0.0);
    // Fixed first end: deflections k_z L^2 / 2 along y, -k_y L^2 / 2 along z, rotations k L.
    const Eigen::Vector3d moved = axes.transpose() * Eigen::Vector3d(2 * elongation, 2 * curvature_z, -2 * curvature_y);
    const Eigen::Vector3d turned = axes.transpose() * Eigen::Vector3d(0.0, 2 * curvature_y, 2 * curvature_z);
    for (int c = 0; c < 3; ++c) {
      const int move = body.dofs->dof(1, static_cast<Component>(c)),
                turn = body.dofs->dof(1, static_cast<Component>(c + 3));
      if (move >= 0) u[move] = moved[c];
      if (turn >= 0) u[turn] = turned[c];
    }
    CHECK((body.assembler->internal_forces(u) - body.assembler->external_forces(applied(load), 0.0)).norm() < 1e-14);
    CHECK(largest_stress(body.assembler->stresses(u, applied(load), 0.0)) < 1e-14);
    CHECK(body.assembler->stresses(body.zero(), applied(load), 0.0).at(0, 0, 0) == exactly(-100.0 * 0.5 * elongation));
    // No energy where there is no stress; held back, that of what the section bears.
    const auto loads = applied(load);
    body.assembler->impose_strains(loads, 0.0);
    const double held =
        0.5 * 2.0 * 100.0 *
        (0.5 * elongation * elongation + 0.02 * curvature_y * curvature_y + 0.03 * curvature_z * curvature_z);
    CHECK(std::abs(body.assembler->elastic_energies(u).values[0]) <= 1e-14 * held);
    CHECK(body.assembler->elastic_energies(body.zero()).values[0] == Approx(held).epsilon(1e-13));
    CHECK(body.assembler->geometric_stiffness(u).norm() <= 1e-13);
    if (beam) {
      const auto parts = body.assembler->elastic_energies(body.zero());
      const auto part = [&](const char* name) { return parts.at(0, 0, parts.component(name)); };
      CHECK(part("TRAC_COM") == Approx(50.0 * elongation * elongation).epsilon(1e-13));
      CHECK(part("FLEX_Y") == Approx(2.0 * curvature_y * curvature_y).epsilon(1e-13));
      CHECK(part("FLEX_Z") == Approx(3.0 * curvature_z * curvature_z).epsilon(1e-13));
      continue;
    }
    load.initial_slender_strains[0].strain[1] = 1.0;
    CHECK_THROWS_WITH(body.assembler->external_forces(applied(load), 0.0), Catch::Contains("curvature"));
  }
}

namespace {

std::shared_ptr<const Material> metal() {
  Material material;
  material.elasticity = IsotropicElasticity{100.0, 0.25};
  material.plasticity.linear = LinearHardening{10.0, 1e-2};
  return std::make_shared<const Material>(material);
}

}  // namespace

TEST_CASE("initial strains push by Hooke's law on a material that flows, which sees the whole strain", "[loads]") {
  const std::array<CellBehaviour, 4> laws = {CellBehaviour{Kinematics::small, Relation::isotropic_linear},
                                             CellBehaviour{Kinematics::logarithmic, Relation::isotropic_linear},
                                             CellBehaviour{Kinematics::multiplicative, Relation::isotropic_linear},
                                             CellBehaviour{Kinematics::green_lagrange, Relation::elastic}};
  for (const CellType type : {CellType::quad8, CellType::tetra10, CellType::hexa8}) {
    CAPTURE(name_of(type));
    const Body body(single_cell(type, 0.04), dimension(type) == 3 ? Formulation::solid : Formulation::plane_strain,
                    metal());
    Load load;
    load.initial_strains.push_back({0, strain_of(dimension(type)), {}});
    const auto loads = applied(load, [](double t) { return t; });
    const Eigen::VectorXd pushes = body.assembler->external_forces(loads, 1.0);
    const Eigen::VectorXd u =
        body.displacements([&](const Point& x, int c) { return stretched(x, c, dimension(type)); });
    for (const CellBehaviour& law : laws) {
      const BehaviourOfCells behaviours = {law};
      Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &behaviours);
      assembler.impose_strains(loads, 1.0);
      CHECK((assembler.external_forces(loads, 1.0) - pushes).norm() <= 1e-14 * pushes.norm());
      // Results show the stress of the law, which is in balance with those forces.
      CHECK(assembler.initial_strain_forces(loads, 1.0).norm() == 0.0);
      CHECK(assembler.stresses(u, loads, 1.0).values == assembler.stresses(u).values);
      CHECK(largest_stress(assembler.stresses(body.zero(), loads, 1.0)) == 0.0);
      if (law.relation == Relation::isotropic_linear) CHECK(assembler.internal_variables(u).at(0, 0, 0) > 0.0);
    }
  }
}

TEST_CASE("with the pressure as an unknown the law sees strains less the initial ones", "[loads]") {
  const Body body(single_cell(CellType::quad8, 0.04), Formulation::plane_strain_swelling, metal());
  Load load;
  load.initial_strains.push_back({0, {1e-3, -1e-3, 0, 3e-4, 0, 0}, {}});
  const auto loads = applied(load, [](double t) { return t; });
  for (const Kinematics kinematics : {Kinematics::small, Kinematics::logarithmic}) {
    const BehaviourOfCells behaviours = {{kinematics, Relation::isotropic_linear}};
    Assembler assembler(body.model, body.materials, body.properties, *body.dofs, &behaviours);
    CHECK_THROWS_WITH(assembler.external_forces(loads, 1.0),
                      Catch::Contains(kinematics == Kinematics::small ? "intensity" : "small strains"));
    assembler.impose_strains(loads, 1.0);
    if (kinematics != Kinematics::small) continue;
    CHECK(assembler.external_forces(loads, 1.0).norm() == 0.0);
    CHECK(assembler.internal_forces(body.zero()).norm() > 1e-3);
  }
}

TEST_CASE("loads without initial strains are not asked for their size", "[loads]") {
  const Body body(single_cell(CellType::quad4, 0.0), Formulation::plane_strain, elastic(100.0, 0.3));
  Load load;
  load.pressures.emplace_back().cell = 0;
  const auto loads =
      applied(load, [](double) -> double { throw Error("out-of-function", "the function ends earlier"); });
  CHECK(ImposedStrains(body.model, loads, 1.0).empty());
}

TEST_CASE("initial strains are refused where there is no such strain", "[loads]") {
  const Body body(with_skin(CellType::hexa8, 0.0), Formulation::solid, elastic(100.0, 0.25));
  Load skin, beam;
  skin.initial_strains.push_back({1, strain, {}});
  beam.initial_slender_strains.push_back({0, {1.0, 0, 0}, {}});
  CHECK_THROWS_WITH(body.assembler->external_forces(applied(skin), 0.0), Catch::Contains("M2"));
  CHECK_THROWS_WITH(body.assembler->external_forces(applied(beam), 0.0), Catch::Contains("M1"));
  const Body plane(single_cell(CellType::quad4), Formulation::axisymmetric, elastic(100.0, 0.25));
  Load out;
  out.initial_strains.push_back({0, {0, 0, 0, 0, 1e-3, 0}, {}});
  CHECK_THROWS_WITH(plane.assembler->external_forces(applied(out), 0.0), Catch::Contains("EPXZ"));
}
