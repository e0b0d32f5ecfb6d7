#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "scene.hpp"
#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace plasticity_test {

constexpr double young = 1000.0;
constexpr double yield = 5.0;
constexpr double slope = 100.0;

/// A square of metal in plane strain (nu = 0, so that it is pulled as a bar) of four cells, whose top moves by `lift`
/// times t.
struct Square {
  Scene scene;
  Scene::Block block;

  explicit Square(double lift, CellBehaviour behaviour = {Kinematics::small, Relation::isotropic_linear})
      : block(scene.block("b", {0, 0}, {1, 1}, 2, 2, young, 0.0)) {
    auto materials = std::make_shared<MaterialField>(*scene.problem.materials);
    for (auto& material : materials->by_cell) {
      if (!material) continue;
      Material metal = *material;
      metal.plasticity.linear = LinearHardening{slope, yield};
      material = std::make_shared<const Material>(metal);
    }
    scene.problem.materials = materials;
    scene.problem.behaviours =
        std::make_shared<const BehaviourOfCells>(static_cast<std::size_t>(scene.mesh->cell_count()), behaviour);
    scene.impose(block.nodes.front(), Component::dy, 0.0);
    for (const auto& row : block.nodes) scene.impose({row.front()}, Component::dx, 0.0);
    scene.impose(block.nodes.back(), Component::dy, lift, true);
  }

  double at_first_point(const char* field, const char* component, std::size_t step) const {
    const auto& values = std::get<ElementField>(scene.result.steps[step].fields.at(field));
    return values.at(0, 0, values.component(component));
  }
};

TEST_CASE("the variables of one step are where the next begins") {
  Square square(0.01);
  NewtonOptions options;
  options.relative_residual = 1e-10;
  square.scene.solve(2, options);
  const double p = square.at_first_point("VARI_ELGA", "V1", 1);
  CHECK(p > 0.0);
  CHECK(square.at_first_point("VARI_ELGA", "V1", 2) > p);
  // Taken back, the stress falls by elasticity alone: the plastic strain stays.
  Square returned(0.01);
  for (AppliedLoad& load : returned.scene.problem.loads)
    if (load.multiplier) load.multiplier = [](double t) { return t < 1.5 ? t : 0.998; };
  returned.scene.solve(2, options);
  CHECK(returned.at_first_point("VARI_ELGA", "V1", 2) == exactly(returned.at_first_point("VARI_ELGA", "V1", 1)));
  CHECK(returned.at_first_point("VARI_ELGA", "V2", 1) == 1.0);
  CHECK(returned.at_first_point("VARI_ELGA", "V2", 2) == 0.0);
}

TEST_CASE("which stiffness the iterations take changes the way, not the solution") {
  NewtonOptions options;
  options.relative_residual = 1e-10;
  Square newton(0.02);
  newton.scene.solve(1, options);
  const double expected = newton.at_first_point("SIEF_ELGA", "SIYY", 1);

  options.max_iterations = 400;
  options.tangent.prediction = options.tangent.correction = TangentKind::elastic;
  Square elastic(0.02);
  elastic.scene.solve(3, options);
  Square reference(0.02);
  NewtonOptions usual;
  usual.relative_residual = 1e-10;
  reference.scene.solve(3, usual);
  CHECK(elastic.at_first_point("SIEF_ELGA", "SIYY", 3) == exactly(reference.at_first_point("SIEF_ELGA", "SIYY", 3)));
  CHECK(elastic.scene.counters.factorisations == 1);
  CHECK(reference.scene.counters.factorisations > 3);

  options = usual;
  options.line_search = LineSearch{};
  options.guess = StepGuess::extrapolate;
  Square guessed(0.02);
  guessed.scene.solve(3, options);
  CHECK(guessed.at_first_point("SIEF_ELGA", "SIYY", 3) == exactly(reference.at_first_point("SIEF_ELGA", "SIYY", 3)));
  CHECK(newton.scene.counters.newton_iterations <= 6);
  CHECK(expected > yield);
}

TEST_CASE("an estimate that overshoots is corrected by the tangent there, boundary and inside together") {
  // Pulled beyond the yield point at full speed, then at a tenth of it: what the estimate has too much flows back as
  // the tangent says. Were the boundary put in its place first, the cells beside it would unload.
  Square slowed(0.02);
  for (AppliedLoad& load : slowed.scene.problem.loads)
    if (load.multiplier) load.multiplier = [](double t) { return t < 2.0 ? t : 2.0 + 0.1 * (t - 2.0); };
  NewtonOptions options;
  options.relative_residual = 1e-10;
  options.guess = StepGuess::extrapolate;
  int iterations = 0;
  slowed.scene.solve(3, options, [&](const IterationReport& report) {
    if (report.instant > 2.5) ++iterations;
  });
  CHECK(iterations <= 3);
}

TEST_CASE(
    "residuals are measured against the forces of an expansion too, and steps of heat alone begin with what it held "
    "up") {
  // Held between two walls and across the plane, free along x: pressed alike in two directions, it flows by half of p
  // in each.
  Square square(0.0);
  Scene& scene = square.scene;
  auto materials = std::make_shared<MaterialField>(*scene.problem.materials);
  for (auto& material : materials->by_cell) {
    if (!material) continue;
    Material metal = *material;
    std::get<IsotropicElasticity>(*metal.elasticity).expansion = 1e-3;
    material = std::make_shared<const Material>(metal);
  }
  CommandVariable heat;
  heat.reference = 0.0;
  for (const double t : {0.0, 4.0})
    heat.snapshots.push_back({t, std::make_shared<const Field>(NodalField{
                                     "TEMP_R", {"TEMP"}, std::vector<double>(scene.mesh->nodes.size(), 5.0 * t)})});
  materials->variables = {heat};
  scene.problem.materials = materials;
  NewtonOptions options;
  options.relative_residual = 1e-10;
  std::vector<IterationReport> reports;
  scene.solve(4, options, [&](const IterationReport& report) { reports.push_back(report); });
  const double strain = 1e-3 * 20.0;
  const double hardness = young * slope / (young - slope);
  CHECK(square.at_first_point("SIEF_ELGA", "SIYY", 4) ==
        exactly(-(yield + 2.0 * hardness * strain) / (1.0 + 2.0 * hardness / young)));
  // A corner is pushed by half the width of a cell times E alpha T; what pushes inner nodes balances.
  for (const IterationReport& report : reports)
    if (report.relative_residual > 0.0)
      CHECK(report.absolute_residual / report.relative_residual >= 0.99 * young * 1e-3 * 5.0 * report.instant * 0.25);
  CHECK(scene.counters.newton_iterations <= 12);
}

TEST_CASE("a step that is cut leaves nothing of its trial behind") {
  StepPlan plan({0.0, 1.0});
  plan.cutting = StepCutting{};
  Square cut(0.05);
  NewtonOptions options;
  options.relative_residual = 1e-10;
  options.max_iterations = 4;
  options.tangent.iterations = 0;  // too few and too stiff to arrive at once
  int cuts = 0;
  const auto count = [&](const IterationReport& report) { cuts += !report.event.empty(); };
  try {
    solve_static(cut.scene.problem, plan, options, cut.scene.result, cut.scene.counters, count);
  } catch (const Error& error) {
    CHECK(error.code() == "no-convergence");
  }
  CHECK(cuts > 0);
  const std::size_t last = cut.scene.result.steps.size() - 1;
  REQUIRE(last > 0);
  Square small(0.05);
  solve_static(small.scene.problem, StepPlan({0.0, cut.scene.result.steps[last].instant}), {}, small.scene.result,
               small.scene.counters);
  CHECK(cut.at_first_point("SIEF_ELGA", "SIYY", last) ==
        Approx(small.at_first_point("SIEF_ELGA", "SIYY", 1)).epsilon(1e-5));
}

TEST_CASE("a computation that goes on from an initial state arrives where one in a piece does") {
  NewtonOptions options;
  options.relative_residual = 1e-10;
  for (const CellBehaviour behaviour : {CellBehaviour{Kinematics::small, Relation::kinematic_linear},
                                        CellBehaviour{Kinematics::logarithmic, Relation::isotropic_linear},
                                        CellBehaviour{Kinematics::multiplicative, Relation::isotropic_linear}}) {
    Square whole(0.02, behaviour);
    whole.scene.solve(2, options);
    Square rest(0.02, behaviour);
    auto initial = std::make_shared<InitialState>();
    const auto& fields = whole.scene.result.steps[1].fields;
    initial->displacement = std::get<NodalField>(fields.at("DEPL"));
    initial->stresses = std::get<ElementField>(fields.at("SIEF_ELGA"));
    initial->variables = std::get<ElementField>(fields.at("VARI_ELGA"));
    rest.scene.problem.initial = initial;
    solve_static(rest.scene.problem, StepPlan({1.0, 2.0}), options, rest.scene.result, rest.scene.counters);
    CHECK(rest.scene.result.steps.size() == 2);
    CHECK(rest.at_first_point("SIEF_ELGA", "SIYY", 1) == exactly(whole.at_first_point("SIEF_ELGA", "SIYY", 2)));
    CHECK(rest.at_first_point("VARI_ELGA", "V1", 1) ==
          Approx(whole.at_first_point("VARI_ELGA", "V1", 2)).margin(1e-12));
  }
}

TEST_CASE("an elastic body starts from the stresses that it is given, and differential loads count from there") {
  Square body(0.0, {Kinematics::small, Relation::elastic, true});
  auto initial = std::make_shared<InitialState>();
  Square loaded(0.004, {Kinematics::small, Relation::elastic, true});
  loaded.scene.solve(1);
  const auto& fields = loaded.scene.result.steps[1].fields;
  initial->displacement = std::get<NodalField>(fields.at("DEPL"));
  initial->stresses = std::get<ElementField>(fields.at("SIEF_ELGA"));
  body.scene.problem.initial = initial;
  for (AppliedLoad& load : body.scene.problem.loads) load.differential = true;
  solve_static(body.scene.problem, StepPlan({0.0, 1.0}), {}, body.scene.result, body.scene.counters);
  CHECK(body.scene.displacement(body.block.nodes.back().front(), Component::dy) == exactly(0.004));
  CHECK(body.at_first_point("SIEF_ELGA", "SIYY", 1) == exactly(4.0));
  CHECK(body.scene.counters.factorisations == 1);
}

TEST_CASE("on the updated geometry stresses add up from strains of the step over the length where it ends") {
  Square body(0.1, {Kinematics::updated, Relation::elastic});
  NewtonOptions options;
  options.relative_residual = 1e-12;
  options.max_iterations = 30;
  body.scene.solve(3, options);
  double strain = 0.0;
  for (const int step : {1, 2, 3}) strain += 0.1 / (1.0 + 0.1 * step);
  CHECK(body.at_first_point("SIEF_ELGA", "SIYY", 3) == Approx(young * strain).epsilon(1e-10));
  CHECK(body.at_first_point("SIEF_ELGA", "SIXX", 3) == Approx(0.0).margin(1e-9));
  // Without displacements across, that is nearly the logarithm in short steps.
  Square fine(0.003, {Kinematics::updated, Relation::elastic});
  fine.scene.solve(100, options);
  CHECK(fine.at_first_point("SIEF_ELGA", "SIYY", 100) == Approx(young * std::log(1.3)).epsilon(2e-3));
}

TEST_CASE("steps that extrapolate the flow are linear, and their error is of the order of their length") {
  const auto cumulated = [](int steps, bool extrapolates, long& iterations) {
    Square square(0.02 / steps);
    // A corner that is held makes the flow uneven.
    square.scene.impose({square.block.nodes[2][2]}, Component::dx, 0.0);
    NewtonOptions options;
    options.relative_residual = 1e-9;
    options.extrapolates_flow = extrapolates;
    square.scene.solve(steps, options);
    iterations = square.scene.counters.newton_iterations;
    return square.at_first_point("VARI_ELGA", "V1", static_cast<std::size_t>(steps));
  };
  long iterations = 0;
  const double exact = cumulated(160, false, iterations);
  const double coarse = cumulated(40, true, iterations) - exact;
  CHECK(iterations == 40);
  const double fine = cumulated(80, true, iterations) - exact;
  CHECK(std::abs(coarse) < 0.05 * exact);
  CHECK(std::abs(fine) < 0.7 * std::abs(coarse));

  Square elastic(0.004, {Kinematics::small, Relation::elastic});
  NewtonOptions options;
  options.extrapolates_flow = true;
  elastic.scene.solve(1, options);
  CHECK(elastic.at_first_point("SIEF_ELGA", "SIYY", 1) == exactly(4.0));
  Square moving(0.01, {Kinematics::small, Relation::kinematic_linear});
  CHECK_THROWS_WITH(moving.scene.solve(1, options), Catch::Contains("IMPLEX"));
}

TEST_CASE("the verdict on mixed elements does not depend on the unit of stress") {
  // A free ring that is heated, in logarithmic strains: every length grows by the factor exp(alpha (T - T_ref)).
  constexpr double expansion = 5e-4, heating = 100.0;
  for (const double unit : {1.0, 1e5, 2e11}) {
    CAPTURE(unit);
    Scene scene;
    std::vector<int> nodes;
    for (const auto& [x, y] :
         {std::pair{1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}, {1.5, 0.0}, {2.0, 0.5}, {1.5, 1.0}, {1.0, 0.5}})
      nodes.push_back(scene.node("N" + std::to_string(nodes.size()), x, y));
    scene.cell("ring", CellType::quad8, nodes, Formulation::axisymmetric_swelling);
    scene.impose({nodes[0], nodes[4], nodes[1]}, Component::dy, 0.0);
    IsotropicElasticity elasticity{unit, 0.3};
    elasticity.expansion = expansion;
    Material material;
    material.elasticity = elasticity;
    CommandVariable temperature;
    temperature.reference = 20.0;
    for (const double time : {0.0, 1.0})
      temperature.snapshots.push_back(
          {time, std::make_shared<const Field>(
                     NodalField{"TEMP_R", {"TEMP"}, std::vector<double>(nodes.size(), 20.0 + heating * time)})});
    MaterialField materials;
    materials.by_cell = {std::make_shared<const Material>(material)};
    materials.variables = {temperature};
    scene.problem.materials = std::make_shared<const MaterialField>(materials);
    scene.problem.behaviours =
        std::make_shared<const BehaviourOfCells>(1, CellBehaviour{Kinematics::logarithmic, Relation::elastic});
    scene.solve(1);
    CHECK(scene.displacement(nodes[2], Component::dy) == Approx(std::expm1(expansion * heating)).epsilon(1e-6));
    CHECK(scene.displacement(nodes[2], Component::dx) == Approx(2.0 * std::expm1(expansion * heating)).epsilon(1e-6));
  }
}

}  // namespace plasticity_test
