#include "solver/contact/contact_points.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

#include "solver/tests/nonlinear/scene.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

TEST_CASE("A point between nodes is near those that its shape functions weigh most") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.add_cell(CellType::tria3, std::vector<int>{0, 1, 2});
  const auto is_near = [&](std::array<double, 3> shape, const std::vector<int>& nodes) {
    ContactPoint point;
    point.cell = 0;
    std::ranges::copy(shape, point.shape.begin());
    return is_nearest_to(point, mesh, [&](int node) { return std::ranges::find(nodes, node) != nodes.end(); });
  };
  CHECK(is_near({0.2, 0.6, 0.2}, {1}));
  CHECK_FALSE(is_near({0.2, 0.6, 0.2}, {0, 2}));
  // The middle is as near to all.
  CHECK_FALSE(is_near({1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {0, 1}));
  CHECK(is_near({1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {0, 1, 2}));
}

TEST_CASE("A node on the axis of an axisymmetric surface may not overlap either, on linear and on quadratic faces") {
  // Two faces along the radius, one at height zero, the other at a tenth. Where the radius vanishes the weight of a
  // quadratic rule does too, and so does the integral of the node's shape function.
  const bool quadratic = GENERATE(false, true);
  Scene scene;
  const CellType type = quadratic ? CellType::seg3 : CellType::seg2;
  const auto face = [&](const std::string& name, double height, bool reversed) {
    std::vector<int> nodes = {scene.node(name + "a", reversed ? 1.0 : 0.0, height),
                              scene.node(name + "b", reversed ? 0.0 : 1.0, height)};
    if (quadratic) nodes.push_back(scene.node(name + "m", 0.5, height));
    return scene.cell(name, type, nodes, Formulation::axisymmetric);
  };
  const int master = face("master", 0.0, true);
  const int slave = face("slave", 0.1, false);
  scene.zone({master}, {slave});
  scene.problem.contact->formulation = ContactFormulation::mixed;
  std::vector<Eigen::Vector3d> positions;
  for (const auto& at : scene.mesh->nodes) positions.emplace_back(at[0], at[1], at[2]);
  const auto points = contact_points(*scene.problem.contact, *scene.problem.model, positions, 0.0);
  REQUIRE(points.size() == (quadratic ? 3U : 2U));
  for (const ContactPoint& point : points) {
    CHECK(point.weight > 0.0);
    CHECK(point.status == PairingStatus::paired);
  }
}

TEST_CASE("Under a penalty a node on the axis weighs what the rule gives it at a radius of 1e-7, whatever the size") {
  const double size = GENERATE(1.0, 20.0);
  Scene scene;
  const auto face = [&](const std::string& name, double height, bool reversed) {
    const int first = scene.node(name + "a", reversed ? size : 0.0, height);
    return scene.cell(name, CellType::seg2, {first, scene.node(name + "b", reversed ? 0.0 : size, height)},
                      Formulation::axisymmetric);
  };
  const int master = face("master", 0.0, true), slave = face("slave", 0.1, false);
  scene.zone({master}, {slave});
  scene.problem.contact->formulation = ContactFormulation::mixed;
  scene.problem.contact->zones[0].mixed.penalised = true;
  std::vector<Eigen::Vector3d> positions;
  for (const auto& at : scene.mesh->nodes) positions.emplace_back(at[0], at[1], at[2]);
  const auto points = contact_points(*scene.problem.contact, *scene.problem.model, positions, 0.0);
  REQUIRE(points.size() == 2);
  CHECK(points[0].weight == Approx(0.5 * size * 1e-7));
  CHECK(points[0].bears_nothing);
  CHECK(points[1].weight == Approx(0.5 * size * size));
}

TEST_CASE(
    "On a surface that reaches the axis the weights of a rule with points between nodes add up to the integral of the "
    "radius") {
  const bool quadratic = GENERATE(false, true);
  const auto [rule, order] = GENERATE(std::pair(ContactRule::simpson, 2), std::pair(ContactRule::newton_cotes, 4),
                                      std::pair(ContactRule::gauss, 3));
  Scene scene;
  const auto face = [&](const std::string& name, double height, bool reversed) {
    std::vector<int> nodes = {scene.node(name + "a", reversed ? 2.0 : 0.0, height),
                              scene.node(name + "b", reversed ? 0.0 : 2.0, height)};
    if (quadratic) nodes.push_back(scene.node(name + "m", 1.0, height));
    return scene.cell(name, quadratic ? CellType::seg3 : CellType::seg2, nodes, Formulation::axisymmetric);
  };
  const int master = face("master", 0.0, true), slave = face("slave", 0.1, false);
  scene.zone({master}, {slave});
  scene.problem.contact->formulation = ContactFormulation::mixed;
  scene.problem.contact->zones[0].mixed.rule = rule;
  scene.problem.contact->zones[0].mixed.rule_order = order;
  std::vector<Eigen::Vector3d> positions;
  for (const auto& at : scene.mesh->nodes) positions.emplace_back(at[0], at[1], at[2]);
  double area = 0.0;
  for (const ContactPoint& point : contact_points(*scene.problem.contact, *scene.problem.model, positions, 0.0))
    area += point.weight;
  CHECK(area == Approx(2.0).epsilon(1e-8));
}

TEST_CASE(
    "A node between faces of different thickness sees the mean of both, weighted by their areas, in any order of the "
    "faces") {
  const bool turned = GENERATE(false, true);
  Scene scene;
  const auto segment = [&](const std::string& name, int first, int last) {
    return scene.cell(name, CellType::seg2, {first, last}, Formulation::plane_strain);
  };
  const int master = segment("master", scene.node("ma", 4.0, 0.0), scene.node("mb", -1.0, 0.0));
  const int left = scene.node("a", 0.0, 0.1), shared = scene.node("b", 1.0, 0.1), right = scene.node("c", 3.0, 0.1);
  const int thick = segment("thick", left, shared), thin = segment("thin", shared, right);
  scene.zone({master}, turned ? std::vector{thin, thick} : std::vector{thick, thin});
  scene.problem.contact->formulation = ContactFormulation::mixed;
  scene.problem.contact->zones[0].half_thickness = {{thick, 0.02}, {thin, 0.01}};
  std::vector<Eigen::Vector3d> positions;
  for (const auto& at : scene.mesh->nodes) positions.emplace_back(at[0], at[1], at[2]);
  const auto points = contact_points(*scene.problem.contact, *scene.problem.model, positions, 0.0);
  REQUIRE(points.size() == 3);
  for (const ContactPoint& point : points)
    CHECK(point.thickness == Approx(point.node == left    ? 0.02
                                    : point.node == right ? 0.01
                                                          : (0.02 * 1.0 + 0.01 * 2.0) / 3.0));
}
