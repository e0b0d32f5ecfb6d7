#include "solver/nonlinear/mixed_contact.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/contact/face_rule.hpp"
#include "solver/contact/facet.hpp"
#include "solver/error.hpp"
#include "solver/nonlinear/failure.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace {

double pressure(const Scene& scene, int node, int step = -1) {
  const ResultStep& chosen = step < 0 ? scene.result.steps.back() : scene.result.steps[static_cast<std::size_t>(step)];
  const auto& field = std::get<NodalField>(chosen.fields.at("DEPL"));
  return -field.at(node, field.component("LAGS_C"));
}

double shear_share(const Scene& scene, int node) {
  const auto& field = std::get<NodalField>(scene.result.steps.back().fields.at("DEPL"));
  return field.at(node, field.component("LAGS_F1"));
}

/// Two blocks one above the other, `above` and `below` cells along the contact.
struct Stack {
  Scene scene;
  Scene::Block lower, upper;

  Stack(int below, int above, double gap = 0.0)
      : lower(scene.block("l", {0, 0}, {3, 1}, below, 2, 2e5, 0.0)),
        upper(scene.block("u", {0, 1 + gap}, {3, 1}, above, 2, 2e5, 0.0)) {
    for (const int node : lower.nodes.front()) scene.impose({node}, Component::dy, 0);
    scene.impose({lower.nodes[0][0]}, Component::dx, 0);
    scene.zone(lower.top, upper.bottom);
    scene.problem.contact->formulation = ContactFormulation::mixed;
  }
};

}  // namespace

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

TEST_CASE("Newton's method: a limit below rounding is told from a slow residual") {
  const auto after = [](double relative, double absolute) {
    IterationReport first, last;
    first.absolute_residual = 1e6;
    last.relative_residual = relative;
    last.absolute_residual = absolute;
    return std::vector{first, last};
  };
  CHECK_THROWS_WITH(throw_no_convergence(1.0, after(5e-15, 5e-6), {}, {}),
                    Catch::Contains("more than rounding allows"));
  CHECK_THROWS_WITH(throw_no_convergence(1.0, after(5e-5, 5e4), {}, {}), Catch::Contains("shrinks too slowly"));
  const auto iterations = [](double ratio) {
    std::vector<IterationReport> history(20);
    double share = 1e-9;
    for (IterationReport& line : history) {
      line.relative_residual = share;
      line.absolute_residual = 1e5 * share;
      share *= ratio;
    }
    return history;
  };
  CHECK_THROWS_WITH(throw_no_convergence(1.0, iterations(0.99), {}, {}), Catch::Contains("more than rounding allows"));
  CHECK_THROWS_WITH(throw_no_convergence(1.0, iterations(0.7), {}, {}), Catch::Contains("shrinks too slowly"));
}

TEST_CASE("Newton's method: iterations that go to and fro are told from slow ones") {
  std::vector<IterationReport> history(10);
  for (std::size_t k = 0; k < history.size(); ++k)
    history[k].relative_residual = history[k].absolute_residual = k % 2 == 0 ? 0.12 : 0.086;
  CHECK_THROWS_WITH(throw_no_convergence(1.0, history, {}, {}), Catch::Contains("to and fro"));
  std::vector<IterationReport> resting = history;
  for (IterationReport& line : resting) line.absolute_residual = history.front().absolute_residual;
  CHECK_THROWS_WITH(throw_no_convergence(1.0, resting, {}, {}), Catch::Contains("falls no more"));
  for (std::size_t k = 0; k < history.size(); ++k) history[k].absolute_residual *= 1.0 - 0.01 * static_cast<double>(k);
  CHECK_THROWS_WITH(throw_no_convergence(1.0, history, {}, {}), Catch::Contains("shrinks too slowly"));
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

TEST_CASE("Statuses that do not settle get advice about what there is") {
  const auto advice = [](const ContactDefinition& contact) {
    try {
      throw_condensed_limit(60, contact, false, {});
    } catch (const Error& error) {
      return error.hint();
    }
  };
  ContactDefinition contact;
  contact.zones.resize(1);
  CHECK(advice(contact) == "take smaller steps");
  contact.zones[0].mixed.penalised = true;
  CHECK(advice(contact) == "take smaller steps, or a smaller penalty (E_N)");
  contact.formulation = ContactFormulation::mixed;
  contact.zones[0].mixed.penalised = false;
  contact.zones[0].mixed.rule = ContactRule::simpson;
  CHECK_THAT(advice(contact), Catch::Contains("INTEGRATION='AUTO'") && !Catch::Contains("penalty"));
  contact.zones[0].mixed.friction = 0.3;
  CHECK_THAT(advice(contact), !Catch::Contains("LISSAGE"));
  contact.zones[0].normal_side = NormalSide::average;
  CHECK_THAT(advice(contact), Catch::Contains("LISSAGE='OUI'"));
}
