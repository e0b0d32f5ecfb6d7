#include <catch2/catch.hpp>

#include <cmath>

#include "solver/error.hpp"
#include "solver/materials/behaviour/von_mises.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace von_mises_test {

constexpr double young = 200e3;
constexpr double poisson = 0.3;
constexpr double yield = 250.0;
constexpr double slope = 20e3;

Plasticity metal() {
  Plasticity plasticity;
  plasticity.linear = LinearHardening{slope, yield};
  plasticity.prager = Property(9e3);
  TabulatedFunction curve;
  curve.parameter = "EPSI";
  curve.x = {yield / young, 0.01, 0.05};
  curve.y = {yield, 400.0, 500.0};
  curve.right = Extension::linear;
  plasticity.traction = TractionHardening{{}, {curve}, {}, {}};
  plasticity.power = PowerHardening{yield, 0.3, 4.0};
  plasticity.nonlinear = NonlinearHardeningOf<Property>{.initial = yield,
                                                        .slope = 500.0,
                                                        .first = 120.0,
                                                        .first_rate = 30.0,
                                                        .power_factor = 40.0,
                                                        .power_offset = 1e-3,
                                                        .power = 0.4};
  return plasticity;
}

PlasticPoint point_of(Relation relation) {
  return plastic_point(IsotropicElasticity{young, poisson}, metal(), relation, MaterialPoint());
}

PlasticResponse step(Relation relation, const PlasticState& state, const Vector6d& increment, bool in_plane = false) {
  const PlasticPoint point = point_of(relation);
  return in_plane ? integrate_von_mises_in_plane(point, point, state, increment)
                  : integrate_von_mises(point, point, state, increment);
}

constexpr Relation relations[] = {
    Relation::elastic,         Relation::isotropic_linear,    Relation::isotropic_traction,
    Relation::isotropic_power, Relation::isotropic_nonlinear, Relation::kinematic_linear,
    Relation::mixed_linear,    Relation::mixed_traction};

/// The strain increment along x under which only the stress xx is not zero.
PlasticResponse pull(Relation relation, const PlasticState& state, double along) {
  Vector6d increment = Vector6d::Zero();
  increment[0] = along;
  PlasticResponse response;
  for (int iteration = 0; iteration < 50; ++iteration) {
    response = step(relation, state, increment);
    const Eigen::Vector2d across = response.state.stress.segment<2>(1);
    if (across.norm() < 1e-11 * young) break;
    increment.segment<2>(1) -= response.tangent.block<2, 2>(1, 1).inverse() * across;
  }
  return response;
}

Vector6d size_of_flow() {
  Vector6d increment;
  increment << 0.004, -0.001, -0.0005, 0.003, -0.002, 0.001;
  return increment;
}

TEST_CASE("plastic tangents are the derivatives of the stress, in space and in plane stress") {
  for (const Relation relation : relations) {
    for (const bool in_plane : {false, true}) {
      PlasticState state = step(relation, {}, size_of_flow(), in_plane).state;
      Vector6d increment = -0.5 * size_of_flow();
      increment[1] += 0.006;  // flows on in another direction
      const PlasticResponse response = step(relation, state, increment, in_plane);
      constexpr double h = 1e-7;
      for (int k = 0; k < 6; ++k) {
        if (in_plane && k == 2) continue;
        Vector6d ahead = increment, behind = increment;
        ahead[k] += h;
        behind[k] -= h;
        const Vector6d column = (step(relation, state, ahead, in_plane).state.stress -
                                 step(relation, state, behind, in_plane).state.stress) /
                                (2 * h);
        // Rounding of the stresses (some 1e-13) over h, and the third derivative (young / strain^2) times h^2.
        CHECK((column - response.tangent.col(k)).cwiseAbs().maxCoeff() < 1e-6 * young);
      }
      CHECK((response.tangent - response.tangent.transpose()).cwiseAbs().maxCoeff() < 1e-12 * young);
    }
  }
}

TEST_CASE("a bar follows its traction curve, and comes back elastically") {
  for (const Relation relation : {Relation::isotropic_linear, Relation::kinematic_linear, Relation::mixed_linear}) {
    constexpr double strain = 0.01;
    const PlasticResponse pulled = pull(relation, {}, strain);
    const double expected = yield + slope * (strain - yield / young);
    CHECK(pulled.state.stress[0] == exactly(expected));
    // Isotropic hardening yields again at minus that stress; kinematic hardening twice the first yield stress lower;
    // both when the surface, which has grown by what it has not moved, is crossed.
    const double p = strain - expected / young;
    const double moved = relation == Relation::isotropic_linear   ? 0.0
                         : relation == Relation::kinematic_linear ? expected - yield
                                                                  : 1.5 * 9e3 * p;
    const double radius = expected - moved;
    const double back = -2.0 * radius / young;
    CHECK_FALSE(pull(relation, pulled.state, 0.999 * back).state.flowing);
    CHECK(pull(relation, pulled.state, 1.001 * back).state.flowing);
  }
  const PlasticResponse on_curve = pull(Relation::isotropic_traction, {}, 0.03);
  CHECK(on_curve.state.stress[0] == exactly(450.0));
  const double p = on_curve.state.p;
  CHECK(p == exactly(0.03 - 450.0 / young));
  const PlasticResponse power = pull(Relation::isotropic_power, {}, 0.02);
  const double plastic = 0.02 - power.state.stress[0] / young;
  CHECK(power.state.stress[0] == exactly(yield + yield * std::pow(young * plastic / (0.3 * yield), 0.25)));
}

TEST_CASE("under simple shear the shear stress follows the curve by the factor sqrt 3, whatever the number of steps") {
  const double shear = young / (2 * (1 + poisson));
  PlasticState state;
  constexpr int steps = 7;
  constexpr double angle = 0.02;
  for (int k = 0; k < steps; ++k) {
    Vector6d increment = Vector6d::Zero();
    increment[3] = angle / steps;
    state = step(Relation::isotropic_linear, state, increment).state;
  }
  const double modulus = young * slope / (young - slope);
  // tau sqrt 3 = yield + H p and angle = tau / G + sqrt 3 p.
  const double p = (angle - yield / std::sqrt(3.0) / shear) / (std::sqrt(3.0) + modulus / (std::sqrt(3.0) * shear));
  CHECK(state.p == exactly(p));
  CHECK(state.stress[3] == exactly((yield + modulus * p) / std::sqrt(3.0)));
}

TEST_CASE("plane stress has no stress across, and pulls like a bar") {
  Vector6d increment = Vector6d::Zero();
  increment[0] = 0.01;
  const PlasticPoint point = point_of(Relation::isotropic_linear);
  PlasticResponse response;
  for (int iteration = 0; iteration < 50; ++iteration) {
    response = integrate_von_mises_in_plane(point, point, {}, increment);
    increment[1] -= response.state.stress[1] / response.tangent(1, 1);
  }
  CHECK(response.state.stress[2] == 0.0);
  CHECK(response.state.stress[0] == exactly(yield + slope * (0.01 - yield / young)));
}

TEST_CASE("what flows in plane stress is what the secants of Code_Aster 17.3 leave at a tolerance") {
  Plasticity plasticity;
  plasticity.linear = LinearHardening{100.0, 20.0};
  TabulatedFunction curve;
  curve.parameter = "EPSI";
  curve.x = {0.02, 0.04, 0.08, 0.2};
  curve.y = {20.0, 24.0, 27.0, 30.0};
  plasticity.traction = TractionHardening{{}, {curve}, {}, {}};
  plasticity.power = PowerHardening{20.0, 1.0, 5.0};
  Vector6d increment;
  increment << 0.03, -0.01, 0.0, 0.03, 0.0, 0.0;
  const auto flowed = [&](Relation relation, double tolerance) {
    const PlasticPoint point = plastic_point(IsotropicElasticity{1000.0, 0.3}, plasticity, relation, MaterialPoint());
    return integrate_von_mises_in_plane(point, point, {}, increment, tolerance);
  };
  struct Figures {
    Relation relation;
    double coarse, fine;  // at 1e-2 and 1e-6
  };
  for (const auto& [relation, coarse, fine] :
       {Figures{Relation::isotropic_linear, 0.01378917016387164, 0.01376747756876287},
        Figures{Relation::isotropic_traction, 0.01231392488780273, 0.01229836297709837},
        Figures{Relation::isotropic_power, 0.002674504480376959, 0.002661528085788677}}) {
    CHECK(flowed(relation, 1e-2).state.p == Approx(coarse).epsilon(1e-13));
    CHECK(flowed(relation, 1e-6).state.p == Approx(fine).epsilon(1e-13));
    CHECK(flowed(relation, 1e-14).state.p == Approx(flowed(relation, 0.0).state.p).epsilon(1e-12));
    const Matrix6d exact = flowed(relation, 0.0).tangent;
    CHECK((flowed(relation, 1e-14).tangent - exact).norm() < 1e-11 * exact.norm());
  }
  const Vector6d stress = flowed(Relation::isotropic_linear, 1e-2).state.stress;
  CHECK(stress[0] == Approx(18.6492112383637).epsilon(1e-13));
  CHECK(stress[1] == Approx(0.9547906100400159).epsilon(1e-13));
  CHECK(stress[2] == 0.0);
  CHECK(stress[3] == Approx(6.635407735621383).epsilon(1e-13));
}

TEST_CASE("when the modulus changes, the elastic strain stays") {
  const PlasticPoint before = point_of(Relation::isotropic_linear);
  PlasticPoint now = before;
  now.shear *= 0.5;
  now.bulk *= 0.25;
  PlasticState state;
  state.stress << 100.0, 10.0, 10.0, 0.0, 0.0, 30.0;
  const PlasticResponse response = integrate_von_mises(before, now, state, Vector6d::Zero());
  CHECK(response.state.stress[5] == exactly(15.0));
  CHECK(response.state.stress.head<3>().sum() == exactly(0.25 * 120.0));
}

TEST_CASE("what flows by a stiffer modulus alone, the strain going back, has a tangent without the flow") {
  const PlasticPoint before = point_of(Relation::isotropic_linear);
  PlasticPoint now = before;
  now.shear *= 1.5;
  const PlasticState state = pull(Relation::isotropic_linear, {}, 0.01).state;
  Vector6d back = Vector6d::Zero();
  back[0] = -1e-5;
  const PlasticResponse returning = integrate_von_mises(before, now, state, back);
  REQUIRE(returning.state.p > state.p);
  const PlasticResponse pulled = integrate_von_mises(before, now, state, -back);
  const double shear = 0.5 * (returning.tangent(0, 0) - returning.tangent(0, 1));
  CHECK(returning.tangent(3, 3) == exactly(shear));  // isotropic: no direction of flow
  CHECK(shear < now.shear);                          // but softened by it
  CHECK(pulled.tangent(0, 0) < 0.7 * returning.tangent(0, 0));
}

TEST_CASE("a step begins with what flowed flowing on, and with its expansion held up by the elastic material") {
  const PlasticPoint before = point_of(Relation::mixed_linear);
  PlasticPoint now = before;
  now.shear *= 0.9;
  now.bulk *= 0.8;
  PlasticState state = step(Relation::mixed_linear, {}, size_of_flow()).state;
  REQUIRE(state.flowing);
  Vector6d cold = Vector6d::Zero(), warm = Vector6d::Zero();
  cold.head<3>().setConstant(1e-3);
  warm.head<3>().setConstant(4e-3);
  const PlasticResponse response = begin_von_mises(before, now, state, cold, warm);
  Vector6d change = response.state.stress - state.stress;
  CHECK(change.tail<3>().norm() == 0.0);
  CHECK(change[0] == exactly(3e-3 * before.bulk - 12e-3 * now.bulk));
  CHECK(response.state.p == state.p);
  // With the same moduli the tangent is that of a step in which nothing moves; of what did not flow it is the elastic
  // one.
  CHECK(begin_von_mises(before, before, state, cold, warm)
            .tangent.isApprox(step(Relation::mixed_linear, state, Vector6d::Zero()).tangent));
  state.flowing = false;
  CHECK(begin_von_mises(before, before, state, cold, warm)
            .tangent.isApprox(step(Relation::elastic, {}, Vector6d::Zero()).tangent));
  const PlasticState flat = step(Relation::mixed_linear, {}, size_of_flow(), true).state;
  const PlasticResponse in_plane = begin_von_mises_in_plane(before, now, flat, cold, warm);
  CHECK(in_plane.state.stress[2] == 0.0);
  CHECK(in_plane.tangent.col(2).norm() == 0.0);
  const double plane_before = young / (1.0 - poisson), e = 9.0 * now.bulk * now.shear / (3.0 * now.bulk + now.shear);
  const double plane_now = e / (1.0 - (e / (2.0 * now.shear) - 1.0));
  CHECK(in_plane.state.stress[0] - flat.stress[0] == exactly(1e-3 * plane_before - 4e-3 * plane_now));
}

TEST_CASE("softening comes back along its slope however steep it is in a pull, until no yield stress is left") {
  const IsotropicElasticity elasticity{young, poisson};
  Plasticity plasticity = metal();
  Vector6d sheared = Vector6d::Zero();
  const double shear_modulus = young / (2.0 * (1.0 + poisson));
  for (const double falling : {-slope, -young, -1e300}) {
    plasticity.linear->slope = falling;
    const PlasticPoint point = plastic_point(elasticity, plasticity, Relation::isotropic_linear, MaterialPoint());
    const double modulus = falling / (1.0 - falling / young);
    sheared[3] = 1.05 * yield / (std::sqrt(3.0) * shear_modulus);
    const PlasticResponse flowed = integrate_von_mises(point, point, {}, sheared);
    CHECK(flowed.state.p == exactly(0.05 * yield / (3.0 * shear_modulus + modulus)));
    CHECK(std::sqrt(3.0) * flowed.state.stress[3] == exactly(yield + modulus * flowed.state.p));
    sheared[3] *= 100.0;
    CHECK_THROWS_WITH(integrate_von_mises(point, point, {}, sheared), Catch::Contains("falls below zero"));
  }
}

TEST_CASE("a material that lacks what the law needs, or whose curve is off the elastic line, says so") {
  const IsotropicElasticity elasticity{young, poisson};
  CHECK_THROWS_WITH(plastic_point(elasticity, {}, Relation::isotropic_linear, MaterialPoint()),
                    Catch::Contains("ECRO_LINE"));
  Plasticity plasticity = metal();
  plasticity.linear->slope = 2.0 * young;
  CHECK_THROWS_WITH(plastic_point(elasticity, plasticity, Relation::isotropic_linear, MaterialPoint()),
                    Catch::Contains("slope"));
  plasticity.traction->curves.front().x.front() *= 1.5;
  CHECK_THROWS_WITH(plastic_point(elasticity, plasticity, Relation::isotropic_traction, MaterialPoint()),
                    Catch::Contains("elastic line"));
  plasticity = metal();
  plasticity.linear->yield = -1.0;
  for (const Relation relation : {Relation::isotropic_linear, Relation::kinematic_linear})
    CHECK_THROWS_WITH(plastic_point(elasticity, plasticity, relation, MaterialPoint()),
                      Catch::Contains("the yield stress is -1,"));
  plasticity.nonlinear =
      NonlinearHardeningOf<Property>{.initial = 1.0, .power_factor = 1.0, .power_offset = -1.0, .power = 0.5};
  CHECK_THROWS_WITH(plastic_point(elasticity, plasticity, Relation::isotropic_nonlinear, MaterialPoint()),
                    Catch::Contains("not a number"));
  plasticity.nonlinear->power_offset = 0.0;
  CHECK_NOTHROW(plastic_point(elasticity, plasticity, Relation::isotropic_nonlinear, MaterialPoint()));
  plasticity.nonlinear =
      NonlinearHardeningOf<Property>{.initial = 1.0, .power_factor = 1.0, .power_offset = 1e-9, .power = -0.5};
  CHECK_THROWS_WITH(plastic_point(elasticity, plasticity, Relation::isotropic_nonlinear, MaterialPoint()),
                    Catch::Contains("steeper than the stress can follow"));
  plasticity = metal();
  plasticity.prager = -10.0 * young;
  CHECK_THROWS_WITH(plastic_point(elasticity, plasticity, Relation::mixed_linear, MaterialPoint()),
                    Catch::Contains("moves backwards"));
  plasticity = metal();
  plasticity.traction->curves.front().right = Extension::excluded;
  const PlasticPoint ended = plastic_point(elasticity, plasticity, Relation::isotropic_traction, MaterialPoint());
  Vector6d far = Vector6d::Zero();
  far[3] = 0.5;
  CHECK_THROWS_WITH(integrate_von_mises(ended, ended, {}, far), Catch::Contains("beyond the last point"));
}

}  // namespace von_mises_test
