#include "solver/contact_law/secant_friction.hpp"

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/law_tangents.hpp"

using namespace comma::solver;
using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

ContactLaw rubbing() {
  ContactLaw law;
  law.penalised = law.friction_penalised = true;
  law.augmentation = 4000.0;
  law.friction = 0.3;
  law.friction_augmentation = 700.0;
  return law;
}

Vector2d at(const LinearShear& shear, const Vector2d& slip) { return shear.at_rest + shear.stiffness * slip; }

}  // namespace

TEST_CASE(
    "What sticks resists by the penalty, what slides by the limit of friction, and the secant goes through both") {
  const Vector2d slip(0.02, 0.05);
  for (const double relief : {0.0, 0.4, 1.0}) {
    const SecantShear sliding = secant_shear(rubbing(), 100.0, slip, relief);
    CHECK(sliding.status == ContactStatus::sliding);
    CHECK(sliding.value.norm() == Approx(30.0).epsilon(1e-14));
    CHECK(sliding.value.normalized().dot(slip.normalized()) == Approx(1.0).epsilon(1e-14));
    CHECK((at(sliding.linear, slip) - sliding.value).norm() < 1e-12);
    // Without slip the secant leaves no shear, the tangent of a limit that stays all of it.
    CHECK((sliding.linear.at_rest - relief * sliding.value).norm() < 1e-12);
    const SecantShear sticking = secant_shear(rubbing(), 1000.0, slip, relief);
    CHECK(sticking.status == ContactStatus::sticking);
    CHECK((sticking.value - 700.0 * slip).norm() < 1e-12);
    CHECK(sticking.linear.at_rest.isZero());
  }
}

TEST_CASE("Relieved of all along the slip, the secant is the tangent of a limit that stays") {
  const Vector2d slip(0.02, 0.05);
  const double step = 1e-7;
  Matrix2d derivative;
  for (int k = 0; k < 2; ++k) {
    const Vector2d shift = step * Vector2d::Unit(k);
    derivative.col(k) = (secant_shear(rubbing(), 100.0, slip + shift, 1.0).value -
                         secant_shear(rubbing(), 100.0, slip - shift, 1.0).value) /
                        (2.0 * step);
  }
  const Matrix2d tangent = secant_shear(rubbing(), 100.0, slip, 1.0).linear.stiffness;
  CHECK((tangent - derivative).norm() < 1e-6 * tangent.norm());
}

TEST_CASE("A linear shear stands for friction in the law") {
  ContactLaw law = rubbing();
  law.linear_shear = secant_shear(law, 100.0, {0.02, 0.05}, 0.4).linear;
  const auto value = [&](const Eigen::Vector3d& multiplier, const Eigen::Vector3d& jump) {
    return contact_law(law, ContactStatus::sliding, multiplier, jump);
  };
  check_tangents(value);
  CHECK((value({0, 0, 0}, {-0.01, 0.1, 0.2}).traction.tail<2>() + at(*law.linear_shear, {0.1, 0.2})).norm() < 1e-12);
  law.dead = Vector2d::UnitX();
  check_tangents(value);
  CHECK(value({0, 0, 0}, {-0.01, 0.1, 0.2}).traction[1] == 0.0);
}
