#include "solver/fields/stresses/loading_indicators.hpp"

#include <cmath>
#include <optional>

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

using Tensor = std::array<double, 6>;

ElementField zeros(std::size_t count, std::initializer_list<const char*> names) {
  return {"", Support::gauss_point, {names.begin(), names.end()}, {0, 8}, std::vector<double>(8 * count, 0.0)};
}

/// DERA_ELGA of a point of an elastic cube: DCHA_V and DCHA_T.
std::array<double, 2> from_to(const Tensor& before, const Tensor& after) {
  const Body body(single_cell(CellType::hexa8, 0.0), Formulation::solid, elastic(young, poisson));
  const ElementField first = uniform(stress_names, before), second = uniform(stress_names, after);
  const ElementField none = zeros(
      12, {"DCHA_V", "DCHA_T", "IND_DCHA", "VAL_DCHA", "X11", "X22", "X33", "X12", "X13", "X23", "RADI_V", "ERR_RADI"});
  const FieldInput input{body.model, body.materials, body.properties, body.assembler->state()};
  const ElementField field = local_indicators(input, {first, second, nullptr, nullptr, nullptr, &none});
  CHECK(field.at(0, 5, 2) == 0.0);
  return {field.at(0, 5, 0), field.at(0, 5, 1)};
}

TEST_CASE("local indicators tell loading and unloading", "[fields]") {
  const auto loads = from_to({100, 0, 0, 0, 0, 0}, {125, 0, 0, 0, 0, 0});
  CHECK(loads[0] == exactly(0.2));
  CHECK(loads[1] == exactly(0.2));
  CHECK(from_to({100, 0, 0, 0, 0, 0}, {80, 0, 0, 0, 0, 0})[0] == exactly(-0.25));
  // Pressure changes the whole stress and not its deviator.
  const auto pressed = from_to({100, 0, 0, 0, 0, 0}, {200, 100, 100, 0, 0, 0});
  CHECK(pressed[0] == Approx(0.0).margin(1e-15));
  CHECK(pressed[1] == exactly((std::sqrt(1.5 * 6e4) - std::sqrt(1.5e4)) / std::sqrt(1.5 * 6e4)));
  CHECK(from_to({0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0}) == std::array<double, 2>{0.0, 0.0});
}

/// What IND_DCHA, VAL_DCHA, X11, RADI_V and ERR_RADI are along a path of tension and shear, yield being at 100: as
/// Code_Aster 17.3 has them.
TEST_CASE("local indicators of plasticity follow a path as in Code_Aster 17.3", "[fields]") {
  Material material;
  material.elasticity = IsotropicElasticity{young, poisson};
  material.plasticity.linear = LinearHardening{slope, 100.0};
  const Body body(single_cell(CellType::hexa8, 0.0), Formulation::solid, std::make_shared<const Material>(material));
  const BehaviourOfCells behaviours = {{Kinematics::small, Relation::isotropic_linear}};
  const FieldInput input{body.model, body.materials, body.properties, body.assembler->state()};
  constexpr int steps = 8;
  constexpr std::array<std::array<double, 4>, steps> path = {{// tension, shear, cumulated plastic strain, flows
                                                              {0, 0, 0, 0},
                                                              {90, 0, 0, 0},
                                                              {130, 10, 0.01, 1},
                                                              {140, 20, 0.02, 1},
                                                              {100, 20, 0.02, 0},
                                                              {60, 0, 0.02, 0},
                                                              {30, 0, 0.02, 0},
                                                              {10, 30, 0.02, 0}}};
  constexpr std::array<std::array<double, 5>, steps - 1> expected = {
      {{0, 0, 0, 0, 0},
       {1, 0, 0, 8.233706452e-2, 0},
       {2, 0, 0, 3.900057187e-1, 5.502683014e-2},
       {-1, 0, 42.92746566, 2.927465661e-2, 0},
       {-2, 1.086040632, 42.92746566, 7.142857143e-2, 0},
       {-2, 1.086040632, 42.92746566, 0, 0},
       {-2, 1.086040632, 42.92746566, 6.407893959e-1, 0}}};
  const auto stress = [&](std::size_t k) { return uniform(stress_names, {path[k][0], 0, 0, path[k][1], 0, 0}); };
  const auto variables = [&](std::size_t k) {
    ElementField field = zeros(0, {"V1", "V2"});
    for (int point = 0; point < 8; ++point) field.values.insert(field.values.end(), {path[k][2], path[k][3]});
    return field;
  };
  std::optional<ElementField> before;
  for (std::size_t k = 0; k + 1 < steps; ++k) {
    const ElementField now = stress(k), next = stress(k + 1), has = variables(k), then = variables(k + 1);
    const ElementField found =
        local_indicators(input, {now, next, &has, &then, &behaviours, before ? &*before : nullptr});
    constexpr std::array columns = {2, 3, 4, 10, 11};
    for (std::size_t i = 0; i < columns.size(); ++i)
      CHECK(found.at(0, 3, columns[i]) == Approx(expected[k][i]).epsilon(1e-8).margin(1e-12));
    before = found;
  }
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
