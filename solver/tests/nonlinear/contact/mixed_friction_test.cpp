// Friction of the mixed formulation and of penalties in whole scenes.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "solver/contact/face_rule.hpp"
#include "solver/contact/facet.hpp"
#include "solver/nonlinear/contact/mixed_contact.hpp"
#include "solver/tests/exactly.hpp"
#include "solver/tests/nonlinear/stack.hpp"

using namespace comma::solver;
using comma::solver::testing::pressure;
using comma::solver::testing::Scene;
using comma::solver::testing::shear_share;
using comma::solver::testing::Stack;

TEST_CASE("A pressed block sticks below the limit of friction and slides at it") {
  for (const double drag : {0.29, 0.31}) {
    Scene scene;
    const auto ground = scene.block("g", {0, 0}, {6, 1}, 6, 1, 2e7, 0.0);
    const auto block = scene.block("b", {1, 1}, {1, 0.1}, 2, 1, 2e7, 0.0);
    for (const auto& row : ground.nodes)
      for (const int node : row) {
        scene.impose({node}, Component::dx, 0);
        scene.impose({node}, Component::dy, 0);
      }
    scene.zone(ground.top, block.bottom).mixed.friction = 0.3;
    scene.problem.contact->formulation = ContactFormulation::mixed;
    constexpr double weight = 400.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = i == 1 ? 0.5 : 0.25;
      scene.force(block.nodes[1][i], Component::dy, -weight * share);
      scene.force(block.nodes[0][i], Component::dx, drag * weight * share);
      scene.ground_spring("k" + std::to_string(i), block.nodes[0][i], 100.0 * share, 0.0);
    }
    scene.solve(1);
    const double moved = scene.displacement(block.nodes[0][1], Component::dx);
    // Beyond the limit springs of 100 in all take what friction does not: 0.01 * 400 / 100.
    CHECK(moved == Approx(drag < 0.3 ? 0.0 : 0.04).margin(1e-9));
    CHECK(scene.contact(block.nodes[0][1], "CONT") == (drag < 0.3 ? 1.0 : 2.0));
    if (drag > 0.3) CHECK(std::abs(shear_share(scene, block.nodes[0][1])) == exactly(1.0));
  }
}

TEST_CASE("With a penalty of friction what sticks creeps by its share of the limit over the coefficient") {
  for (const ContactRule rule : {ContactRule::automatic, ContactRule::gauss})
    for (const bool penalised : {false, true}) {
      Scene scene;
      const auto ground = scene.block("g", {0, 0}, {6, 1}, 6, 1, 2e7, 0.0);
      const auto block = scene.block("b", {1, 1}, {1, 0.1}, 2, 1, 2e7, 0.0);
      for (const auto& row : ground.nodes) scene.impose(row, Component::dx, 0), scene.impose(row, Component::dy, 0);
      MixedZone& mixed = scene.zone(ground.top, block.bottom).mixed;
      mixed.rule = rule;
      mixed.friction = 0.3;
      mixed.friction_penalised = true;
      mixed.friction_penalty = 50.0;
      mixed.penalised = penalised;
      mixed.augmentation = 1e9;
      scene.problem.contact->formulation = ContactFormulation::mixed;
      constexpr double weight = 400.0, drag = 80.0, spring = 100.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double share = i == 1 ? 0.5 : 0.25;
        scene.force(block.nodes[1][i], Component::dy, -weight * share);
        scene.force(block.nodes[0][i], Component::dx, drag * share);
        scene.ground_spring("k" + std::to_string(i), block.nodes[0][i], spring * share, 0.0);
      }
      scene.solve(1);
      const double moved = drag / (mixed.friction * weight * mixed.friction_penalty + spring);
      CHECK(scene.displacement(block.nodes[0][1], Component::dx) == Approx(moved).epsilon(1e-6));
      CHECK(std::abs(shear_share(scene, block.nodes[0][1])) == Approx(mixed.friction_penalty * moved).epsilon(1e-6));
    }
}

TEST_CASE("Between nodes the law of friction holds in the mean, of shares of its limit") {
  // Nodes on a rigid floor, pressed alike, dragged less and less: the first slide, the last stick, and one face does
  // both.
  constexpr int faces = 3;
  Scene scene;
  const auto floor = scene.block("g", {-1, -1}, {8, 1}, 1, 1, 2e5, 0.0);
  for (const auto& row : floor.nodes) scene.impose(row, Component::dx, 0), scene.impose(row, Component::dy, 0);
  std::vector<int> nodes, slave;
  std::vector<double> drags;
  constexpr double spring = 100.0;
  for (int i = 0; i <= faces; ++i) {
    nodes.push_back(scene.node("s" + std::to_string(i), i, 0.0));
    scene.ground_spring("k" + std::to_string(i), nodes.back(), spring, 100.0);
    drags.push_back(i == 1 ? 4.5 : i == 0 ? 3.0 : 1.0 / i);
    scene.force(nodes.back(), Component::dx, drags.back());
    scene.force(nodes.back(), Component::dy, i == 0 || i == faces ? -5.0 : -12.0);
  }
  for (int i = 0; i < faces; ++i) {
    const auto first = static_cast<std::size_t>(i);
    slave.push_back(scene.cell("f" + std::to_string(i), CellType::seg2, {nodes[first + 1], nodes[first]},
                               Formulation::plane_strain));
  }
  ContactZone& zone = scene.zone(floor.top, slave);
  zone.master_normal = NormalRule::fixed;
  zone.master_vector = {0, 1, 0};
  zone.mixed.rule = ContactRule::gauss;
  zone.mixed.friction = 0.3;
  zone.mixed.friction_augmentation = 20.0;
  scene.problem.contact->formulation = ContactFormulation::mixed;
  scene.solve(1);

  std::vector<double> left(nodes.size(), 0.0), force(nodes.size(), 0.0);
  int sliding = 0, sticking = 0;
  for (const int face : slave) {
    const auto own = scene.mesh->cell(face);
    for (const FacePoint& at : face_rule(CellType::seg2, ContactRule::gauss, 0)) {
      const auto shape = facet_shape(CellType::seg2, at.xi).values;
      double pressed = 0.0, share = 0.0, slip = 0.0;
      for (std::size_t i = 0; i < own.size(); ++i) {
        pressed += shape[i] * pressure(scene, own[i]);
        share += shape[i] * shear_share(scene, own[i]);
        slip -= shape[i] *
                scene.displacement(own[i], Component::dx);  // along the tangent, the normal turned by a right angle
      }
      const double trial = share + zone.mixed.friction_augmentation * slip;
      const double cut = std::clamp(trial, -1.0, 1.0);
      ++(cut == trial ? sticking : sliding);
      for (std::size_t i = 0; i < own.size(); ++i) {
        const auto known = static_cast<std::size_t>(std::ranges::find(nodes, own[i]) - nodes.begin());
        left[known] += 0.5 * at.weight * shape[i] * pressed * (cut - share);  // a face is half its reference cell
        force[known] += 0.5 * at.weight * shape[i] * zone.mixed.friction * pressed * cut;
      }
    }
  }
  CHECK(sliding > 0);
  CHECK(sticking > 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    CHECK(left[i] == Approx(0.0).margin(1e-8));
    CHECK(-force[i] == Approx(drags[i] - spring * scene.displacement(nodes[i], Component::dx)).margin(1e-8));
  }
}

TEST_CASE("Friction that goes on as in the step before takes few iterations") {
  const auto solved = [](int steps) {
    Stack stack(40, 28);
    stack.scene.problem.contact->zones.front().mixed.friction = 0.3;
    stack.scene.problem.contact->geometry_update = GeometryUpdate::none;
    const auto& top = stack.upper.nodes.back();
    for (std::size_t column = 0; column < top.size(); ++column) {
      const double across = 2.0 * static_cast<double>(column) / 28.0 - 1.0;
      stack.scene.impose({top[column]}, Component::dx, 5e-4, true);
      stack.scene.impose({top[column]}, Component::dy, -2e-3 * (1.0 - across * across), true);
    }
    stack.scene.solve(steps);
    return stack;
  };
  const Stack once = solved(1), often = solved(6);
  REQUIRE(once.scene.counters.contact_iterations > 3);
  CHECK(often.scene.counters.contact_iterations <= once.scene.counters.contact_iterations + 5 * 3);
  for (const int node : once.upper.nodes[0]) {
    CHECK(pressure(often.scene, node) == Approx(6.0 * pressure(once.scene, node)).epsilon(1e-9).margin(1e-9));
    CHECK(shear_share(often.scene, node) == Approx(shear_share(once.scene, node)).margin(1e-9));
  }
}

TEST_CASE("A long contact that slides takes few solutions a step, whatever the formulation") {
  // Beyond the size up to which the compliance of all unknowns on the surfaces is kept.
  const int above = 300;
  std::vector<double> sums;
  for (const ContactFormulation formulation : {ContactFormulation::mixed, ContactFormulation::discrete}) {
    Stack stack(260, above);
    Scene& scene = stack.scene;
    scene.problem.contact->formulation = formulation;
    scene.impose(stack.upper.nodes.back(), Component::dx, 0.001, true);  // a tenth of a cell a step
    for (std::size_t column = 0; column <= above; ++column)
      scene.impose({stack.upper.nodes.back()[column]}, Component::dy, 0.01 - 0.02 * static_cast<double>(column) / above,
                   true);
    scene.solve(4);
    double sum = 0.0, deepest = 0.0, open = 0.0;
    for (const int node : stack.upper.nodes[0]) {
      const double gap = scene.contact(node, "JEU");
      const double force = scene.contact(node, "RN");
      if (std::isnan(gap)) continue;  // beyond the end of the other surface
      sum += force;
      deepest = std::min(deepest, gap);
      open = std::max(open, std::abs(gap * force));
      CHECK(force >= 0.0);
    }
    // Lengths are of order one, displacements of order 0.01.
    CHECK(deepest > -1e-11);
    CHECK(open < 1e-9 * sum);
    CHECK(sum > 0.0);
    // One solution a slave node once, and then few at each position of the surfaces.
    CHECK(scene.counters.pairings >= 8);
    CHECK(scene.counters.solves < above + 80 * scene.counters.pairings);
    sums.push_back(sum);
  }
  CHECK(sums[0] == Approx(sums[1]).epsilon(1e-3));  // the weights of nodes differ at the ends
}

TEST_CASE("Between nodes points that nothing can drag leave the shears of their nodes to others") {
  std::vector<double> shares;
  for (const double augmentation : {1.0, 2e5}) {
    Stack stack(3, 3);
    MixedZone& mixed = stack.scene.problem.contact->zones.front().mixed;
    mixed.rule = ContactRule::gauss;
    mixed.friction = 5.0;
    mixed.augmentation = mixed.friction_augmentation = augmentation;
    // Both bodies are held along the first face.
    for (const std::size_t node : {0U, 1U}) {
      stack.scene.impose({stack.lower.nodes.back()[node]}, Component::dx, 0);
      stack.scene.impose({stack.upper.nodes.front()[node]}, Component::dx, 0);
    }
    stack.scene.impose(stack.upper.nodes.back(), Component::dy, -0.02);
    stack.scene.impose(stack.upper.nodes.back(), Component::dx, 0.01);
    stack.scene.solve(1);
    shares.push_back(shear_share(stack.scene, stack.upper.nodes.front()[1]));
  }
  CHECK(std::abs(shares[0]) > 0.01);
  CHECK(shares[1] == Approx(shares[0]).epsilon(1e-4));
}
