#include "solver/fields/loading_indicators.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace loading_indicators_test {

constexpr double young = 2e5, poisson = 0.3, yield = 200.0, slope = 2e3;
constexpr double shear = young / (2 * (1 + poisson));
constexpr double modulus = young * slope / (young - slope);  ///< dR/dp
constexpr std::array<const char*, 6> stress_names = {"SIXX", "SIYY", "SIZZ", "SIXY", "SIXZ", "SIYZ"};
constexpr std::array<const char*, 6> strain_names = {"EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"};

/// The same tensor at the eight points of one HEXA8.
ElementField uniform(const std::array<const char*, 6>& names, const std::array<double, 6>& tensor) {
  ElementField field{"", Support::gauss_point, {names.begin(), names.end()}, {0, 8}, {}};
  for (int point = 0; point < 8; ++point) field.values.insert(field.values.end(), tensor.begin(), tensor.end());
  return field;
}

struct Indicators {
  double by_yield, by_energy;
};

/// Of a cube that has flowed by p along X, under the stress `stress` along X.
Indicators after_tension(double p, double stress) {
  Material material;
  material.elasticity = IsotropicElasticity{young, poisson};
  material.plasticity.linear = LinearHardening{slope, yield};
  const Body body(single_cell(CellType::hexa8, 0.0), Formulation::solid, std::make_shared<const Material>(material));
  const BehaviourOfCells behaviours = {{Kinematics::small, Relation::isotropic_linear}};
  const ElementField plastic = uniform(strain_names, {p, -0.5 * p, -0.5 * p, 0.0, 0.0, 0.0});
  const ElementField stresses = uniform(stress_names, {stress, 0.0, 0.0, 0.0, 0.0, 0.0});
  ElementField variables{"VARI_R", Support::gauss_point, {"V1", "V2"}, {0, 8}, {}};
  for (int point = 0; point < 8; ++point) variables.values.insert(variables.values.end(), {p, 1.0});
  const FieldInput input{body.model, body.materials, body.properties, body.assembler->state()};
  const PlasticFields fields{plastic, stresses, variables, &behaviours};
  return {yield_indicator(input, fields).at(0, 3, 0), energy_indicator(input, fields).at(0, 3, 0)};
}

std::array<double, 3> from_to(const std::array<double, 6>& before, const std::array<double, 6>& after) {
  const ElementField field = local_indicators(uniform(stress_names, before), uniform(stress_names, after));
  return {field.at(0, 5, 0), field.at(0, 5, 1), field.at(0, 5, 2)};
}

TEST_CASE("local indicators tell loading, unloading and turning", "[fields]") {
  const auto loads = from_to({100, 0, 0, 0, 0, 0}, {125, 0, 0, 0, 0, 0});
  CHECK(loads[0] == exactly(0.2));
  CHECK(loads[1] == exactly(0.2));
  CHECK(loads[2] == Approx(0.0).margin(1e-15));
  CHECK(from_to({100, 0, 0, 0, 0, 0}, {80, 0, 0, 0, 0, 0})[0] == exactly(-0.25));
  // Shear upon tension: the change is normal to what was there.
  CHECK(from_to({100, 0, 0, 0, 0, 0}, {100, 0, 0, 50, 0, 0})[2] == exactly(1.0));
  // Pressure changes the whole stress and not its deviator.
  const auto pressed = from_to({100, 0, 0, 0, 0, 0}, {200, 100, 100, 0, 0, 0});
  CHECK(pressed[0] == Approx(0.0).margin(1e-15));
  CHECK(pressed[1] == exactly((std::sqrt(1.5 * 6e4) - std::sqrt(1.5e4)) / std::sqrt(1.5 * 6e4)));
  CHECK(from_to({0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0}) == std::array<double, 3>{0.0, 0.0, 0.0});
}

TEST_CASE("global indicators are zero on a proportional way and see what unloads", "[fields]") {
  constexpr double p = 0.02;
  constexpr double radius = yield + modulus * p;
  const Indicators loaded = after_tension(p, radius);
  CHECK(loaded.by_yield == Approx(0.0).margin(1e-14));
  CHECK(loaded.by_energy == Approx(0.0).margin(1e-13));
  CHECK(after_tension(p, 0.25 * radius).by_yield == exactly(0.75));
  const Indicators unloaded = after_tension(p, 0.0);
  CHECK(unloaded.by_yield == 1.0);
  // The straight way to the strain that is left flows by less and keeps elastic energy.
  const double flowed = (3 * shear * p - yield) / (3 * shear + modulus);
  const double reached = yield + modulus * flowed;
  const double straight = reached * reached / (6 * shear) + yield * flowed + 0.5 * modulus * flowed * flowed;
  CHECK(unloaded.by_energy == exactly(1.0 - straight / (yield * p + 0.5 * modulus * p * p)));
  const Indicators elastic = after_tension(0.0, 0.5 * yield);
  CHECK(elastic.by_yield == 0.0);
  CHECK(elastic.by_energy == Approx(0.0).margin(1e-14));
}

}  // namespace loading_indicators_test
