// Command variables in the elements: free and restrained expansion.
#include <cmath>

#include <catch2/catch.hpp>

#include "sample_meshes.hpp"
#include "solver/fields/stresses/strains.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace thermal_test {

const double young = 2e11;
const double poisson = 0.3;
const double alpha = 1.2e-5;
const double rise = 80.0;

std::shared_ptr<const Material> expanding(Property modulus = young) {
  Material material;
  IsotropicElasticity elasticity{std::move(modulus), poisson};
  elasticity.expansion = alpha;
  material.elasticity = elasticity;
  return std::make_shared<const Material>(material);
}

/// 20 degrees of reference, and everywhere `rise` more.
CommandVariable uniform_heating(const Mesh& mesh) {
  CommandVariable variable;
  variable.right = Extension::constant;
  variable.reference = 20.0;
  NodalField field{"TEMP_R", {"TEMP"}, std::vector<double>(mesh.nodes.size(), 20.0 + rise)};
  variable.snapshots = {{0.0, std::make_shared<const Field>(field)}};
  return variable;
}

void heat(Body& body) {
  body.materials.variables = {uniform_heating(*body.model.mesh)};
  body.assembler->set_time(0.0);
}

std::shared_ptr<Mesh> slanted_bar() {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}, {2, 1, 2}};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  return mesh;
}

ElementProperties section_on_first_cell() {
  ElementProperties properties;
  BeamSection section;
  section.area = 0.02;
  section.inertia_y = section.inertia_z = 1e-5;
  section.torsion = 2e-5;
  properties.sections[0] = section;
  return properties;
}

struct Case {
  CellType type;
  Formulation formulation;
};

std::vector<Case> continua() {
  std::vector<Case> cases;
  for (const CellType type : plane_types) {
    for (const auto f : {Formulation::plane_stress, Formulation::axisymmetric}) cases.push_back({type, f});
  }
  for (const CellType type : solid_types) cases.push_back({type, Formulation::solid});
  return cases;
}

TEST_CASE("a body that expands freely is free of stress and energy", "[elements][thermal]") {
  for (const Case& c : continua()) {
    CAPTURE(name_of(c.type), static_cast<int>(c.formulation));
    Body body(single_cell(c.type, 0.03), c.formulation, expanding());
    heat(body);
    const auto u = body.displacements([](const Point& x, int k) { return alpha * rise * x[k]; });
    const double scale = young * alpha * rise;
    for (const double stress : body.assembler->stresses(u).values) CHECK(std::abs(stress) < 1e-12 * scale);
    CHECK(body.assembler->internal_forces(u).cwiseAbs().maxCoeff() < 1e-12 * scale);
    CHECK(std::abs(body.assembler->elastic_energies(u).values[0]) < 1e-20 * scale);
  }
}

TEST_CASE("plane strain holds the expansion across the plane back: SIZZ = -E alpha dT", "[elements][thermal]") {
  Body body(single_cell(CellType::quad8, 0.03), Formulation::plane_strain, expanding());
  heat(body);
  const double stretch = (1 + poisson) * alpha * rise;
  const auto u = body.displacements([&](const Point& x, int k) { return stretch * x[k]; });
  const ElementField stress = body.assembler->stresses(u);
  for (int point = 0; point < stress.points(0); ++point) {
    CHECK(stress.at(0, point, 0) == Approx(0.0).margin(1e-12 * young));
    CHECK(stress.at(0, point, 2) == exactly(-young * alpha * rise));
  }
}

TEST_CASE("clamped bodies, bars and beams are compressed by E alpha dT", "[elements][thermal]") {
  Body cube(single_cell(CellType::hexa20), Formulation::solid, expanding());
  heat(cube);
  CHECK(cube.assembler->stresses(cube.zero()).at(0, 5, 1) == exactly(-young * alpha * rise / (1 - 2 * poisson)));
  for (const auto formulation : {Formulation::bar, Formulation::euler_beam, Formulation::timoshenko_beam}) {
    Body bar(slanted_bar(), std::vector{formulation}, expanding(), section_on_first_cell());
    heat(bar);
    const ElementField forces = bar.assembler->stresses(bar.zero());
    CHECK(forces.at(0, 0, 0) == exactly(-young * 0.02 * alpha * rise));
    // Energy 1/2 E A strain^2 L with L = 3.
    CHECK(bar.assembler->elastic_energies(bar.zero()).values[0] ==
          exactly(0.5 * young * 0.02 * std::pow(alpha * rise, 2) * 3));
    const auto free = bar.displacements([](const Point& x, int k) { return k < 3 ? alpha * rise * x[k] : 0.0; });
    CHECK(bar.assembler->internal_forces(free).cwiseAbs().maxCoeff() < 1e-13 * young * 0.02 * alpha * rise);
  }
}

TEST_CASE("the forces of command variables are what the linear problem needs on its right-hand side",
          "[elements][thermal]") {
  Body body(single_cell(CellType::penta15, 0.03), Formulation::solid, expanding());
  heat(body);
  const auto u = body.displacements([](const Point& x, int k) { return 1e-3 * std::sin(2 * x[0] - x[1] + x[2] + k); });
  const Eigen::VectorXd linear = body.dense_stiffness() * u - body.assembler->variable_forces();
  CHECK((body.assembler->internal_forces(u) - linear).cwiseAbs().maxCoeff() < 1e-11 * linear.cwiseAbs().maxCoeff());
}

TEST_CASE("a modulus that falls with temperature softens stiffness and stresses at each instant",
          "[elements][thermal]") {
  const Property softening([](const MaterialPoint& at) { return young * (1 - at[Parameter::temperature] / 1000); });
  Body hot(single_cell(CellType::tetra10), Formulation::solid, expanding(softening));
  heat(hot);
  const int version = hot.assembler->stiffness_version();
  Body same(single_cell(CellType::tetra10), Formulation::solid, elastic(0.9 * young, poisson));
  const Eigen::MatrixXd expected = same.dense_stiffness();
  CHECK((hot.dense_stiffness() - expected).cwiseAbs().maxCoeff() < 1e-12 * expected.cwiseAbs().maxCoeff());
  hot.assembler->set_time(1.0);
  CHECK(hot.assembler->stiffness_version() != version);
  Body constant(single_cell(CellType::tetra10), Formulation::solid, expanding());
  const int constant_version = constant.assembler->stiffness_version();
  heat(constant);
  CHECK(constant.assembler->stiffness_version() == constant_version);
}

TEST_CASE("a material that needs a temperature names the cell that has none", "[elements][thermal]") {
  TabulatedFunction table;
  table.x = {0.0, 1000.0};
  table.y = {young, 0.1 * young};
  const Body body(single_cell(CellType::quad4), Formulation::plane_strain,
                  expanding(tabulated_property(table, Parameter::temperature)));
  CHECK_THROWS_WITH(body.assembler->stiffness(body.zero()), Catch::Contains("temperature") && Catch::Contains("M1"));
}

TEST_CASE("the elastic energy without temperature is half of u K u", "[elements]") {
  for (const Case& c : continua()) {
    CAPTURE(name_of(c.type), static_cast<int>(c.formulation));
    const Body body(single_cell(c.type, 0.04), c.formulation, elastic(young, poisson));
    const auto u =
        body.displacements([](const Point& x, int k) { return 1e-3 * std::cos(x[0] - 2 * x[1] + x[2] + k); });
    CHECK(body.assembler->elastic_energies(u).values[0] == exactly(0.5 * u.dot(body.dense_stiffness() * u)));
  }
}

}  // namespace thermal_test
