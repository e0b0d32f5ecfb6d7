#include "solver/nonlinear/contact/mixed_contact.hpp"

#include <catch2/catch.hpp>

#include "solver/tests/nonlinear/scene.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace joint_iterations_test {

constexpr double young = 1000.0;
constexpr double yield = 5.0;
constexpr double slope = 100.0;

/// A block that comes down tilted on one of metal, which may flow: the contact grows from the left end.
struct Press {
  Scene scene;
  Scene::Block below, above;

  explicit Press(bool jointly, bool flows = true)
      : below(scene.block("b", {0, 0}, {3, 1}, 6, 2, young, 0.0)),
        above(scene.block("a", {0, 1}, {3, 1}, 5, 2, 10 * young, 0.0)) {
    const auto is_metal = [&](std::size_t cell) {
      return scene.mesh->cell_name(static_cast<int>(cell)).front() == 'b';
    };
    auto materials = std::make_shared<MaterialField>(*scene.problem.materials);
    BehaviourOfCells behaviours(materials->by_cell.size());
    for (std::size_t cell = 0; cell < behaviours.size(); ++cell) {
      if (!materials->by_cell[cell] || !is_metal(cell)) continue;
      if (!flows) continue;
      Material metal = *materials->by_cell[cell];
      metal.plasticity.linear = LinearHardening{slope, yield};
      materials->by_cell[cell] = std::make_shared<const Material>(metal);
      behaviours[cell] = {Kinematics::small, Relation::isotropic_linear};
    }
    scene.problem.materials = materials;
    scene.problem.behaviours = std::make_shared<const BehaviourOfCells>(behaviours);
    for (const int node : below.nodes.front()) scene.impose({node}, Component::dy, 0);
    scene.impose({below.nodes[0][0], above.nodes.back()[0]}, Component::dx, 0);
    for (std::size_t column = 0; column <= 5; ++column)
      scene.impose({above.nodes.back()[column]}, Component::dy, 0.01 * static_cast<double>(column) - 0.03, true);
    scene.zone(below.top, above.bottom);
    scene.problem.contact->formulation = ContactFormulation::mixed;
    scene.problem.contact->geometry_tolerance = 1e-10;
    scene.problem.contact->max_geometry_updates = 100;
    scene.problem.contact->joint_iterations = jointly;
    // As stiff as the bodies: statuses must not swing to and fro.
    scene.problem.contact->zones.front().mixed.augmentation = young;
  }

  /// How deep the nodes along the contact have sunk in the end.
  std::vector<double> solve(const std::vector<double>& instants, int most_iterations, int depth,
                            double residual = 1e-11) {
    StepPlan plan(instants);
    plan.cutting = StepCutting{};
    plan.cutting->depth = depth;
    NewtonOptions options;
    options.relative_residual = residual;
    options.max_iterations = most_iterations;
    solve_static(scene.problem, plan, options, scene.result, scene.counters);
    std::vector<double> sunk;
    for (const int node : below.nodes.back()) sunk.push_back(scene.displacement(node, Component::dy));
    return sunk;
  }
};

void check_same(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == Approx(b[i]).epsilon(1e-8).margin(1e-12));
}

TEST_CASE("Statuses and geometry within the iterations on the bodies lead where settling them in each does") {
  const std::vector<double> instants = {0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0};
  Press settled(false), joint(true);
  const std::vector<double> reference = settled.solve(instants, 20, 0);
  CHECK(reference.front() < -1e-3);
  CHECK(settled.scene.contact(settled.above.nodes[0].back(), "CONT") == 0.0);  // part of the surfaces has opened
  check_same(joint.solve(instants, 20, 3), reference);
  CHECK(joint.scene.result.steps.size() == instants.size());
  CHECK(joint.scene.counters.newton_iterations < settled.scene.counters.newton_iterations);
}

TEST_CASE(
    "A step on whose way statuses swing to and fro is cut, and solved with contact settled in each iteration where it "
    "may not be") {
  const std::vector<double> instants = {0.0, 0.5, 1.0};
  Press settled(false), cut(true), whole(true);
  const std::vector<double> reference = settled.solve(instants, 20, 0);
  cut.solve(instants, 20, 3);
  CHECK(cut.scene.result.steps.size() > instants.size());
  check_same(whole.solve(instants, 20, 0), reference);
  CHECK(whole.scene.result.steps.size() == instants.size());
}

TEST_CASE("Joint iterations of elastic bodies end where the geometry is at rest to what is asked for") {
  const std::vector<double> instants = {0.0, 0.5, 1.0};
  const std::vector<double> reference = Press(false, false).solve(instants, 20, 0);
  const auto iterations = [&](double tolerance) {
    Press joint(true, false);
    joint.scene.problem.contact->joint_geometry_tolerance = tolerance;
    const std::vector<double> sunk = joint.solve(instants, 30, 0, 1e-2);
    if (tolerance < 1e-9) check_same(sunk, reference);
    return joint.scene.counters.newton_iterations;
  };
  const int until_at_rest = iterations(1e-10);
  CHECK(iterations(1.0) < until_at_rest);
  CHECK(until_at_rest < 30);  // no step was begun again
}

TEST_CASE(
    "A step of elastic bodies that joint iterations do not solve is not cut: contact is settled within each "
    "iteration") {
  const std::vector<double> instants = {0.0, 0.5, 1.0};
  Press joint(true, false);
  check_same(joint.solve(instants, 2, 3), Press(false, false).solve(instants, 20, 0));
  CHECK(joint.scene.result.steps.size() == instants.size());
}

}  // namespace joint_iterations_test
