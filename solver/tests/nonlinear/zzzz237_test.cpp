// The founding scene: a square of 100 m on springs of 10 N/m, pressed by 20 m on a nearly rigid one or on a unilateral
// support. Uniform compression with free lateral expansion in plane strain:
//   sigma_yy = E / (1 - nu^2) * eps_yy,  eps_xx = -nu / (1 - nu) * eps_yy,  eps_yy = -20 / 100.
#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/error.hpp"

using namespace comma::solver;
using comma::solver::testing::Scene;

namespace zzzz237_test {

constexpr double young = 2e9;
constexpr double poisson = 0.3;
constexpr double exact_dx = 0.3 / 0.7 * 0.2 * 50.0;                       // 4.285714... m
constexpr double exact_force = young / (1.0 - 0.09) * 0.2 * 100.0 / 2.0;  // 2.197802...e10 N

struct Founding : Scene {
  int a, b, c, d, e, f, g, h, r1, r2, ab, he;

  /// Cells as in the seed mesh: the squares are numbered clockwise, the skin is turned outwards.
  explicit Founding(bool with_support) {
    a = node("A", 0, 0), b = node("B", 100, 0), c = node("C", 100, 100), d = node("D", 0, 100);
    r1 = node("R1", 0, 200), r2 = node("R2", 100, 200);
    e = node("E", -50, 0), f = node("F", -50, -100), g = node("G", 150, -100), h = node("H", 150, 0);
    solid("ABCD", CellType::quad4, {b, a, d, c}, young, poisson);
    spring("K1", r1, d, 10, 10);
    spring("K2", r2, c, 10, 10);
    ab = skin("AB", a, b);
    impose({r1, r2}, Component::dx, 0);
    impose({r1, r2}, Component::dy, 0);
    impose({c, d}, Component::dy, -1, true);
    if (!with_support) return;
    solid("EFGH", CellType::quad4, {f, e, h, g}, 2e16, poisson);
    he = skin("HE", h, e);
    impose({f, g}, Component::dx, 0);
    impose({f, g}, Component::dy, 0);
  }

  void check_position(double dy_margin) const {
    const double left = displacement(a, Component::dx);
    const double right = displacement(b, Component::dx);
    CHECK(left == Approx(-exact_dx).epsilon(1e-6));
    CHECK(right == Approx(exact_dx).epsilon(1e-6));
    // Springs of 10 N/m hold a body of 2e9 Pa: nothing but accuracy centres it.
    CHECK(std::abs(left + right) < 1e-8);
    CHECK(std::abs(displacement(a, Component::dy)) < dy_margin);
    CHECK(std::abs(displacement(b, Component::dy)) < dy_margin);
    CHECK(internal_force(a, Component::dy) == Approx(exact_force).epsilon(1e-6));
    CHECK(internal_force(b, Component::dy) == Approx(exact_force).epsilon(1e-6));
  }
};

TEST_CASE("zzzz237 B: a unilateral support carries the square", "[zzzz237]") {
  for (const auto method : {LinearMethod::eigen_ldlt, LinearMethod::cholmod, LinearMethod::mumps}) {
    Founding scene(false);
    scene.bound({scene.a, scene.b}, Component::dy, -1.0, [](const Point&, double) { return 0.0; });
    NewtonOptions options;
    options.method = method;
    scene.solve(20, options);
    INFO(name_of(method));
    REQUIRE(scene.result.steps.size() == 21);
    scene.check_position(1e-12);
    CHECK(scene.counters.factorisations == 1);
    CHECK(scene.counters.newton_iterations == 20);
  }
}

TEST_CASE("zzzz237 A: contact with a nearly rigid square", "[zzzz237]") {
  for (const auto method : {LinearMethod::eigen_ldlt, LinearMethod::cholmod, LinearMethod::mumps}) {
    Founding scene(true);
    ContactZone& zone = scene.zone({scene.he}, {scene.ab});
    zone.master_normal = NormalRule::fixed;
    zone.master_vector = {0, 1, 0};
    NewtonOptions options;
    options.method = method;
    scene.solve(20, options);
    INFO(name_of(method));
    // The support gives way by force / stiffness: 2.2e10 / 2e16, about 1e-6 m.
    scene.check_position(1e-6);
    CHECK(scene.contact(scene.a, "CONT") == 2.0);
    CHECK(scene.contact(scene.a, "RN") == Approx(exact_force).epsilon(1e-6));
    CHECK(scene.contact(scene.a, "RNY") == Approx(-exact_force).epsilon(1e-6));
    CHECK(scene.contact(scene.a, "JEU") == Approx(0.0).margin(1e-12));
    CHECK(std::isnan(scene.contact(scene.e, "CONT")));
    CHECK(scene.counters.factorisations == 1);
  }
}

TEST_CASE("zzzz237 A: the outward normals of the skin do as well as a given one", "[zzzz237]") {
  Founding scene(true);
  scene.zone({scene.he}, {scene.ab}).normal_side = GENERATE(NormalSide::master, NormalSide::slave, NormalSide::average);
  scene.solve(20);
  scene.check_position(1e-6);
}

TEST_CASE("zzzz237 A: slave nodes beyond the pairing distance pass freely", "[zzzz237]") {
  // A and B touch the support but lie 50 m from its nodes.
  Founding scene(true);
  scene.zone({scene.he}, {scene.ab}).pairing_distance = 1.0;
  scene.solve(20);
  for (const int node : {scene.a, scene.b}) {
    CHECK(scene.displacement(node, Component::dy) == Approx(-20.0).epsilon(1e-12));
    CHECK(std::abs(scene.displacement(node, Component::dx)) < 1e-8);
    CHECK(std::abs(scene.internal_force(node, Component::dy)) < 1e-3);  // 1e-13 of the force that contact would carry
    CHECK(scene.contact(node, "CONT") == 0.0);
  }
  CHECK(scene.counters.factorisations == 1);
}

TEST_CASE("zzzz237 A: a pairing distance that reaches the support's nodes changes nothing", "[zzzz237]") {
  Founding scene(true);
  scene.zone({scene.he}, {scene.ab}).pairing_distance = 60.0;
  scene.solve(20);
  scene.check_position(1e-6);
}

}  // namespace zzzz237_test
