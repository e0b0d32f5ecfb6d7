// Which tangent iterations take beside contact.
#include <functional>

#include <catch2/catch.hpp>

#include "solver/tests/nonlinear/scene.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace contact_tangent_test {

/// The residuals of one step that pulls a block in large strains over another.
std::vector<double> residuals(TangentPolicy policy, const std::function<void(ContactDefinition&)>& change) {
  Scene scene;
  const Scene::Block below = scene.block("b", {0, 0}, {4, 1}, 4, 1, 300.0, 0.0);
  const Scene::Block above = scene.block("a", {0.5, 1}, {3, 1}, 5, 2, 100.0, 0.3);
  scene.problem.behaviours = std::make_shared<const BehaviourOfCells>(
      static_cast<std::size_t>(scene.mesh->cell_count()), CellBehaviour{Kinematics::green_lagrange});
  scene.impose(below.nodes.front(), Component::dx, 0.0);
  scene.impose(below.nodes.front(), Component::dy, 0.0);
  scene.impose(above.nodes.back(), Component::dx, 0.3, true);
  scene.impose(above.nodes.back(), Component::dy, -0.2, true);
  scene.zone(below.top, above.bottom);
  change(*scene.problem.contact);
  NewtonOptions options;
  options.tangent = policy;
  options.relative_residual = 1e-9;
  options.max_iterations = 60;
  std::vector<double> found;
  scene.solve(1, options, [&](const IterationReport& report) { found.push_back(report.relative_residual); });
  return found;
}

constexpr TangentPolicy tangent{}, kept{.iterations = 0},
    elastic{.prediction = TangentKind::elastic, .correction = TangentKind::elastic};
constexpr TangentPolicy elastic_start{.prediction = TangentKind::elastic};

void check_alike(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == Approx(b[i]).epsilon(1e-6).margin(1e-11));
}

TEST_CASE("beside mixed and penalised contact the tangent is that of the moment, whatever is asked for") {
  const auto mixed = [](ContactDefinition& contact) {
    contact.formulation = ContactFormulation::mixed;
    contact.geometry_update = GeometryUpdate::none;
    contact.zones.front().mixed.augmentation = 100.0;
  };
  const auto penalised = [](ContactDefinition& contact) {
    contact.geometry_update = GeometryUpdate::none;
    contact.zones.front().mixed.penalised = true;
    contact.zones.front().mixed.augmentation = 1e4;
  };
  for (const std::function<void(ContactDefinition&)>& contact :
       {std::function<void(ContactDefinition&)>(mixed), std::function<void(ContactDefinition&)>(penalised)}) {
    const std::vector<double> usual = residuals(tangent, contact);
    CHECK(usual.size() < 12);
    check_alike(residuals(kept, contact), usual);
    check_alike(residuals(elastic, contact), usual);
  }
}

TEST_CASE("a new geometry of discrete contact goes on with the iterations of the step") {
  const auto twice = [](ContactDefinition& contact) {
    contact.geometry_update = GeometryUpdate::controlled;
    contact.controlled_updates = 2;
  };
  // After the first solve both take the tangent, in the second geometry too.
  const std::vector<double> usual = residuals(tangent, twice), predicted = residuals(elastic_start, twice);
  check_alike(predicted, usual);
  CHECK(residuals(kept, twice).size() > usual.size());
}

}  // namespace contact_tangent_test
