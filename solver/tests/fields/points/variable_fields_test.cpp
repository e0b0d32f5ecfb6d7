#include "solver/fields/points/variable_fields.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace {

CommandVariable constant(Parameter kind, const char* name, double value, double reference) {
  CommandVariable variable;
  variable.variable = kind;
  variable.reference = reference;
  variable.snapshots = {
      {0.0, std::make_shared<const Field>(NodalField{"TEMP_R", {name}, std::vector<double>(4, value)})}};
  return variable;
}

}  // namespace

TEST_CASE("command variables and their strains at Gauss points", "[fields]") {
  Material concrete;
  IsotropicElasticity elasticity{3e10, 0.2};
  elasticity.expansion = 1e-5;
  elasticity.drying_shrinkage = 6e-5;
  elasticity.hydration_shrinkage = 2e-4;
  concrete.elasticity = elasticity;
  Body body(single_cell(CellType::quad4), Formulation::plane_strain, std::make_shared<const Material>(concrete));
  body.materials.variables = {constant(Parameter::temperature, "TEMP", 70.0, 20.0),
                              constant(Parameter::drying, "SECH", 90.0, 100.0),
                              constant(Parameter::hydration, "HYDR", 0.5, std::nan(""))};
  body.assembler->set_time(0.0);
  const FieldInput input{body.model, body.materials, body.properties, body.assembler->state()};
  const ElementField variables = command_variable_field(input);
  CHECK(variables.points(0) == 4);
  CHECK(variables.at(0, 3, variables.component("TEMP")) == exactly(70.0));
  CHECK(variables.at(0, 3, variables.component("SECH")) == exactly(90.0));
  CHECK(std::isnan(variables.at(0, 3, variables.component("NEUT1"))));
  const ElementField strains = variable_strain_field(input);
  CHECK(strains.at(0, 2, strains.component("EPTHER_N")) == exactly(1e-5 * 50.0));
  CHECK(strains.at(0, 2, strains.component("EPSECH")) == exactly(-6e-5 * 10.0));
  CHECK(strains.at(0, 2, strains.component("EPHYDR")) == exactly(-2e-4 * 0.5));
}

TEST_CASE("a material strains by its own coefficients along its axes", "[fields]") {
  Material ply;
  OrthotropicElasticity elasticity;
  elasticity.young = {1e11, 1e10, 1e10};
  elasticity.shear = {5e9, 5e9, 5e9};
  elasticity.expansion = {1e-6, 2e-5, 3e-5};
  ply.elasticity = elasticity;
  Body body(single_cell(CellType::quad4), Formulation::plane_strain, std::make_shared<const Material>(ply));
  body.materials.variables = {constant(Parameter::temperature, "TEMP", 120.0, 20.0)};
  body.assembler->set_time(0.0);
  const ElementField strains =
      variable_strain_field({body.model, body.materials, body.properties, body.assembler->state()});
  CHECK(strains.at(0, 0, 0) == exactly(1e-4));
  CHECK(strains.at(0, 0, 1) == exactly(2e-3));
  CHECK(strains.at(0, 0, 2) == exactly(3e-3));
}

TEST_CASE("a bar has the mean temperature of its ends and the strain along itself that it causes", "[fields]") {
  Material steel;
  IsotropicElasticity elasticity{2e11, 0.3};
  elasticity.expansion = 1e-5;
  steel.elasticity = elasticity;
  ElementProperties properties;
  properties.sections[0].area = 0.02;
  Body body(single_cell(CellType::seg2), std::vector{Formulation::bar}, std::make_shared<const Material>(steel),
            properties);
  CommandVariable heat = constant(Parameter::temperature, "TEMP", 20.0, 10.0);
  heat.snapshots = {{0.0, std::make_shared<const Field>(NodalField{"TEMP_R", {"TEMP"}, {20.0, 50.0}})}};
  body.materials.variables = {heat};
  body.assembler->set_time(0.0);
  const FieldInput input{body.model, body.materials, body.properties, body.assembler->state()};
  const ElementField variables = command_variable_field(input), strains = variable_strain_field(input);
  REQUIRE(variables.points(0) == 1);
  CHECK(variables.at(0, 0, variables.component("TEMP")) == exactly(35.0));
  CHECK(std::isnan(variables.at(0, 0, variables.component("PTOT"))));
  CHECK(strains.components == std::vector<std::string>{"EPTHER_L"});
  CHECK(strains.at(0, 0, 0) == exactly(1e-5 * 25.0));
}
