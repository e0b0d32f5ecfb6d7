#include "solver/nonlinear/contact/mixed_contact.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "solver/contact/face_rule.hpp"
#include "solver/contact/facet.hpp"
#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"
#include "solver/tests/nonlinear/stack.hpp"

using namespace comma::solver;
using comma::solver::testing::pressure;
using comma::solver::testing::Scene;
using comma::solver::testing::Stack;

TEST_CASE("Mixed contact: uniform compression crosses matching meshes as a uniform pressure") {
  Stack stack(4, 4);
  stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
  stack.scene.impose(stack.upper.nodes.back(), Component::dy, -0.02);
  for (const ContactRule rule :
       {ContactRule::automatic, ContactRule::gauss, ContactRule::simpson, ContactRule::newton_cotes}) {
    stack.scene.problem.contact->zones.front().mixed.rule = rule;
    stack.scene.result = {};
    stack.scene.solve(1);
    // Strain 0.01 in both blocks.
    for (const int node : stack.upper.nodes[0]) CHECK(pressure(stack.scene, node) == Approx(2000.0).epsilon(1e-9));
  }
}

TEST_CASE("Mixed contact: the load that one side gives the other takes, on meshes that do not match") {
  Stack stack(5, 7);
  stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
  stack.scene.impose(stack.upper.nodes.back(), Component::dy, -0.02);
  stack.scene.solve(1);
  double above = 0.0;
  double below = 0.0;
  for (const int node : stack.upper.nodes[0]) above += stack.scene.internal_force(node, Component::dy);
  for (const int node : stack.lower.nodes.back()) below += stack.scene.internal_force(node, Component::dy);
  CHECK(above == Approx(-below).epsilon(1e-10));
  CHECK(stack.scene.counters.factorisations == 1);
}

TEST_CASE("Mixed contact holds a block that nothing else holds, and lets it go again") {
  Stack stack(4, 4, 0.1);
  stack.scene.impose({stack.upper.nodes[0][0], stack.upper.nodes[2][0]}, Component::dx, 0);
  for (std::size_t i = 0; i < 5; ++i)
    stack.scene.force(stack.upper.nodes.back()[i], Component::dy, i == 0 || i == 4 ? -75 : -150);
  stack.scene.solve(1);
  for (const int node : stack.upper.nodes[0]) {
    CHECK(pressure(stack.scene, node) == Approx(200.0).epsilon(1e-8));
    CHECK(stack.scene.displacement(node, Component::dy) == Approx(-0.101).epsilon(1e-9));
  }
}

TEST_CASE("Mixed contact: a failure names what nothing but contact holds") {
  Stack stack(4, 4);
  for (const int node : stack.upper.nodes.back()) {
    stack.scene.force(node, Component::dx, 10.0);
    stack.scene.force(node, Component::dy, -100.0);
  }
  CHECK_THROWS_WITH(stack.scene.solve(1),
                    Catch::Contains("but for contact nothing holds") &&
                        Catch::Contains("translation along X, translation along Y, rotation about Z"));
}

TEST_CASE("Mixed contact stays open over a gap that the load does not close") {
  Stack stack(3, 4, 0.1);
  stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
  stack.scene.impose(stack.upper.nodes.back(), Component::dy, -0.05);
  stack.scene.solve(1);
  for (const int node : stack.upper.nodes[0]) CHECK(pressure(stack.scene, node) == 0.0);
  CHECK(stack.scene.contact(stack.upper.nodes[0][1], "JEU") == exactly(0.05));
}

TEST_CASE("With a penalty the depth is the pressure over the coefficient") {
  Stack stack(4, 4);
  stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
  MixedZone& zone = stack.scene.problem.contact->zones.front().mixed;
  zone.penalised = true;
  zone.augmentation = 1e5;
  stack.scene.impose(stack.upper.nodes.back(), Component::dy, -0.02);
  stack.scene.solve(1);
  // Two springs of E / h = 2e5 and one of 1e5 in series: a quarter, a quarter and a half of 0.02.
  CHECK(pressure(stack.scene, stack.upper.nodes[0][2]) == Approx(1000.0).epsilon(1e-9));
  CHECK(stack.scene.contact(stack.upper.nodes[0][2], "JEU") == Approx(-0.01).epsilon(1e-9));
}

TEST_CASE("Penalties that depths adapt bring points to a hundred times the depth allowed, and none deeper") {
  const auto depth = [](double allowed) {
    Stack stack(4, 4);
    stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
    stack.scene.impose(stack.upper.nodes.back(), Component::dy, -0.02);
    auto& mixed = stack.scene.problem.contact->zones.front().mixed;
    mixed.penalised = true;
    mixed.augmentation = 1.0;
    mixed.adapts_penalty = true;
    mixed.largest_depth = allowed;
    stack.scene.problem.contact->contact_by_newton = true;
    stack.scene.solve(2);
    return stack.scene.displacement(stack.lower.nodes.back()[1], Component::dy) -
           stack.scene.displacement(stack.upper.nodes[0][1], Component::dy);
  };
  // In series: strain (0.02 - depth) / 2, pressure 1e5 (0.02 - depth) = 1e5 depth.
  CHECK(depth(0.02) == Approx(0.01).epsilon(1e-9));
  CHECK(depth(1e-5) == Approx(1e-3).epsilon(1e-6));
}

TEST_CASE("A surface that faces nothing takes no pressure, wherever its points lie") {
  for (const ContactRule rule : {ContactRule::automatic, ContactRule::gauss})
    for (const double friction : {0.0, 0.3}) {
      Scene scene;
      const auto ground = scene.block("g", {0, 0}, {1, 1}, 2, 1, 1000.0, 0.0);
      const auto block = scene.block("b", {5, 0.9}, {1, 1}, 2, 1, 1000.0, 0.0);
      for (const auto& row : ground.nodes) scene.impose(row, Component::dx, 0), scene.impose(row, Component::dy, 0);
      scene.impose(block.nodes[1], Component::dy, -0.1);
      scene.impose({block.nodes[1][0]}, Component::dx, 0);
      MixedZone& mixed = scene.zone(ground.top, block.bottom).mixed;
      mixed.rule = rule;
      mixed.friction = friction;
      scene.problem.contact->formulation = ContactFormulation::mixed;
      scene.solve(1);
      for (const int node : block.nodes[0]) {
        CHECK(pressure(scene, node) == 0.0);
        CHECK(scene.displacement(node, Component::dy) == Approx(-0.1));
      }
    }
}

TEST_CASE("A slave node that is held where it lies carries no pressure and does no harm") {
  Stack stack(4, 4);
  stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
  stack.scene.impose({stack.lower.nodes[2][0]}, Component::dx, 0);
  stack.scene.impose({stack.upper.nodes[0][0], stack.lower.nodes[2][0]}, Component::dy, 0);
  stack.scene.impose(stack.upper.nodes.back(), Component::dy, -0.02);
  stack.scene.solve(1);
  CHECK(pressure(stack.scene, stack.upper.nodes[0][0]) == 0.0);
  CHECK(pressure(stack.scene, stack.upper.nodes[0][3]) > 0.0);
}

TEST_CASE("A load that is lost in the rounding of displacements is no balance") {
  // Nothing but springs of 1e-15 of its stiffness hold the block: displacements are 1e15 times what the load strains,
  // and no double tells.
  Scene scene;
  const auto block = scene.block("b", {0, 0}, {1, 1}, 2, 2, 1e6, 0.0);
  scene.ground_spring("k", block.nodes[0][0], 1e-9, 1e-9);
  scene.ground_spring("l", block.nodes[0][2], 1e-9, 1e-9);
  scene.force(block.nodes[2][1], Component::dy, 1.0);
  CHECK_THROWS_AS(scene.solve(1), Error);
}

TEST_CASE("Imposed displacements that push one surface into the other are an error") {
  Stack stack(4, 4);
  stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
  stack.scene.impose(stack.upper.nodes[0], Component::dy, -0.1);
  stack.scene.impose(stack.lower.nodes.back(), Component::dy, 0);
  CHECK_THROWS_WITH(stack.scene.solve(1), Catch::Contains("imposed displacements push"));
}

TEST_CASE("Discrete contact by a penalty: the force on a slave node is E_N times its depth") {
  Stack stack(4, 4);
  stack.scene.problem.contact->formulation = ContactFormulation::discrete;
  stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
  MixedZone& zone = stack.scene.problem.contact->zones.front().mixed;
  zone.penalised = true;
  zone.augmentation = 1e5;
  stack.scene.impose(stack.upper.nodes.back(), Component::dy, -0.02);
  stack.scene.solve(1);
  double total = 0.0;
  for (const int node : stack.upper.nodes[0]) {
    const double gap = stack.scene.contact(node, "JEU");
    CHECK(stack.scene.contact(node, "RN") == Approx(-1e5 * gap).epsilon(1e-9));
    total -= stack.scene.contact(node, "RNY");
  }
  double carried = 0.0;
  for (const int node : stack.lower.nodes[0]) carried += stack.scene.internal_force(node, Component::dy);
  CHECK(total == Approx(carried).epsilon(1e-10));
}

TEST_CASE("Thickness on either side closes the gap by as much") {
  Stack stack(4, 4, 0.1);
  stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
  ContactZone& zone = stack.scene.problem.contact->zones.front();
  zone.slave_thickness = [](const Point&, double) { return 0.07; };
  zone.master_thickness = [](const Point&, double) { return 0.03; };
  stack.scene.impose(stack.upper.nodes.back(), Component::dy, -0.02);
  for (const ContactFormulation formulation : {ContactFormulation::mixed, ContactFormulation::discrete}) {
    stack.scene.problem.contact->formulation = formulation;
    stack.scene.result = {};
    stack.scene.solve(1);
    for (const int node : stack.upper.nodes[0])
      CHECK(stack.scene.displacement(node, Component::dy) == Approx(-0.01).epsilon(1e-9));
  }
}

TEST_CASE("A guided surface pulls where free contact would open") {
  Stack stack(4, 4);
  stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
  stack.scene.problem.contact->zones.front().mixed.bilateral = true;
  stack.scene.impose(stack.upper.nodes.back(), Component::dy, 0.02);
  stack.scene.solve(1);
  for (const int node : stack.upper.nodes[0]) {
    CHECK(pressure(stack.scene, node) == Approx(-2000.0).epsilon(1e-9));
    CHECK(stack.scene.contact(node, "CONT") == 2.0);  // it is held, though it pulls
  }
}

TEST_CASE("Points of a guided surface close where the step has taken the bodies") {
  // The upper block comes down tilted: its left end closes in the first step, the rest in the second. Any geometry is
  // settled at once.
  std::vector<int> pairings;
  for (const bool guided : {false, true}) {
    Stack stack(6, 6, 0.015);
    Scene& scene = stack.scene;
    scene.problem.contact->zones.front().mixed.bilateral = guided;
    scene.problem.contact->geometry_tolerance = 1e3;
    scene.impose({stack.upper.nodes.back()[0]}, Component::dx, 0);
    for (std::size_t column = 0; column <= 6; ++column)
      scene.impose({stack.upper.nodes.back()[column]}, Component::dy, -0.02 + 0.002 * static_cast<double>(column),
                   true);
    scene.solve(1);
    CHECK(scene.contact(stack.upper.nodes[0].front(), "CONT") == 2.0);
    CHECK(scene.contact(stack.upper.nodes[0].back(), "CONT") == 0.0);
    scene.result = {};
    scene.counters = {};
    scene.solve(2);
    for (const int node : stack.upper.nodes[0]) {
      CHECK(scene.contact(node, "CONT") == 2.0);
      CHECK(scene.contact(node, "JEU") == Approx(0.0).margin(1e-12));
    }
    pairings.push_back(scene.counters.pairings);
  }
  CHECK(pairings[1] == pairings[0] + 1);  // the second step, whose first geometry lets the other points through
}

TEST_CASE("Nodes paired with nodes transmit a uniform pressure on matching meshes") {
  Stack stack(4, 4);
  stack.scene.problem.contact->formulation = ContactFormulation::discrete;
  stack.scene.problem.contact->zones.front().pairing = PairingRule::node;
  stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
  stack.scene.impose(stack.upper.nodes.back(), Component::dy, -0.02);
  stack.scene.solve(1);
  for (const int node : stack.upper.nodes[0])
    CHECK(stack.scene.displacement(node, Component::dy) == Approx(-0.01).epsilon(1e-9));
}

TEST_CASE("Between nodes the law of contact holds in the mean, with one augmentation for all points of a face") {
  // Quadratic faces on springs above a rigid floor, loaded so that they touch in the middle alone. Each third point
  // lies on a middle node.
  Scene scene;
  const auto floor = scene.block("g", {-1, -1}, {8, 1}, 1, 1, 2e5, 0.0);
  for (const auto& row : floor.nodes) scene.impose(row, Component::dx, 0), scene.impose(row, Component::dy, 0);
  constexpr int faces = 3;
  std::vector<int> nodes, slave;
  for (int i = 0; i <= 2 * faces; ++i) {
    const double away = i - faces + 0.3;
    nodes.push_back(scene.node("s" + std::to_string(i), i, 0.02));
    scene.impose({nodes.back()}, Component::dx, 0);
    scene.ground_spring("k" + std::to_string(i), nodes.back(), 0.0, 100.0);
    scene.force(nodes.back(), Component::dy, away * away - 6.0);
  }
  for (int i = 0; i < faces; ++i) {
    const std::size_t first = 2 * static_cast<std::size_t>(i);
    slave.push_back(scene.cell("f" + std::to_string(i), CellType::seg3,
                               {nodes[first], nodes[first + 2], nodes[first + 1]}, Formulation::plane_strain));
  }
  ContactZone& zone = scene.zone(floor.top, slave);
  zone.master_normal = NormalRule::fixed;  // heights are gaps
  zone.master_vector = {0, 1, 0};
  zone.mixed.rule = ContactRule::gauss;
  zone.mixed.augmentation = 40.0;
  scene.problem.contact->formulation = ContactFormulation::mixed;
  scene.solve(1);

  std::vector<double> left(nodes.size(), 0.0), weights(nodes.size(), 0.0);
  double closed = 0.0, open = 0.0;
  for (const int face : slave) {
    const auto own = scene.mesh->cell(face);
    for (const FacePoint& at : face_rule(CellType::seg3, ContactRule::gauss, 0)) {
      const auto shape = facet_shape(CellType::seg3, at.xi).values;
      double multiplier = 0.0, gap = 0.0;
      for (std::size_t i = 0; i < own.size(); ++i) {
        multiplier += shape[i] * pressure(scene, own[i]);
        gap += shape[i] * (scene.mesh->nodes[own[i]][1] + scene.displacement(own[i], Component::dy));
      }
      const double trial = multiplier - zone.mixed.augmentation * gap;
      (trial > 0.0 ? closed : open) += at.weight;
      for (std::size_t i = 0; i < own.size(); ++i) {
        const auto known = static_cast<std::size_t>(std::ranges::find(nodes, own[i]) - nodes.begin());
        left[known] += at.weight * shape[i] * (std::max(0.0, trial) - multiplier);
        weights[known] += at.weight * std::abs(shape[i] * multiplier);
      }
    }
  }
  CHECK(closed > 1.0);
  CHECK(open > 1.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) CHECK(std::abs(left[i]) <= 1e-9 * weights[i]);
}

TEST_CASE("Mixed contact: a node out of reach is an open one, whose gap is told all the same") {
  // Nodes of the slave face the middle of facets, half a cell from the nearest master node.
  Stack stack(3, 2);
  stack.scene.problem.contact->zones.front().pairing_distance = 0.4;
  stack.scene.impose({stack.upper.nodes[0][0]}, Component::dx, 0);
  stack.scene.impose(stack.upper.nodes.back(), Component::dy, -0.02);
  stack.scene.solve(1);
  const int middle = stack.upper.nodes[0][1], corner = stack.upper.nodes[0][0];
  CHECK(stack.scene.contact(middle, "CONT") == 0.0);
  CHECK(stack.scene.contact(middle, "JEU") < -1e-3);
  CHECK(stack.scene.contact(middle, "RN") == 0.0);
  CHECK(stack.scene.contact(corner, "CONT") == 2.0);
}
