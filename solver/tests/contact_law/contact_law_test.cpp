#include "solver/contact_law/contact_law.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/law_tangents.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using Eigen::Vector3d;

TEST_CASE("Tangents of the contact law are its derivatives") {
  for (const bool penalised : {false, true})
    for (const bool friction_penalised : {false, true})
      for (const ContactStatus status : {ContactStatus::open, ContactStatus::sliding, ContactStatus::sticking})
        for (const double share_pressure : {0.0, 80.0, -80.0})
          for (const bool multiplier_takes_part : {false, true}) {
            ContactLaw law;
            law.share_pressure = std::abs(share_pressure);
            if (share_pressure < 0.0) law.held_share = 0.7;
            if (multiplier_takes_part) law.pressure_share = law.shear_share = 0.75;
            law.augmentation = 900.0;
            law.penalised = penalised;
            law.friction = 0.3;
            law.friction_augmentation = 700.0;
            law.friction_penalised = friction_penalised;
            const auto value = [&](const Vector3d& multiplier, const Vector3d& jump) {
              return contact_law(law, status, multiplier, jump);
            };
            check_tangents(value);
            law.dead = Eigen::Vector2d(0.6, 0.8);
            check_tangents(value);
          }
}

TEST_CASE("Along a dead direction the law is that of a point without friction, and across it that of one with it") {
  const Vector3d multiplier(100.0, 7.0, 12.0), jump(-0.03, 0.02, 0.05), across(1.0, 1.0, 0.0);
  for (const double share_pressure : {0.0, 80.0})
    for (const ContactStatus status : {ContactStatus::open, ContactStatus::sliding, ContactStatus::sticking}) {
      ContactLaw law;
      law.augmentation = 900.0;
      law.friction_augmentation = 700.0;
      law.share_pressure = share_pressure;
      const ContactStatus without = status == ContactStatus::open ? status : ContactStatus::sliding;
      const ContactLawValue smooth = contact_law(law, without, multiplier, jump);
      law.friction = 0.3;
      const ContactLawValue whole =
          contact_law(law, status, multiplier.cwiseProduct(across), jump.cwiseProduct(across));
      law.dead = Eigen::Vector2d::UnitY();
      const ContactLawValue value = contact_law(law, status, multiplier, jump);
      CAPTURE(share_pressure, static_cast<int>(status));
      CHECK(value.traction[2] == 0.0);
      // Other points of the nodes may have a shear there.
      const double weight = status == ContactStatus::open ? 1.0 : 1e-8;
      CHECK(value.residual[2] == Approx(weight * smooth.residual[2]).epsilon(1e-14).margin(1e-20));
      CHECK((value.traction - whole.traction).norm() <= 1e-14 * whole.traction.norm());
      CHECK((value.residual - whole.residual).head<2>().norm() <= 1e-14 * whole.residual.norm());
      law.pointwise = true;
      CHECK(contact_law(law, status, multiplier, jump).residual[2] == Approx(smooth.residual[2]).epsilon(1e-14));
    }
}

TEST_CASE("A penalty that the multiplier takes part of is the same penalty once the law holds") {
  ContactLaw law;
  law.penalised = law.friction_penalised = true;
  law.friction = 0.3;
  law.pressure_share = law.shear_share = 0.75;
  law.augmentation = 500.0;
  law.friction_augmentation = 250.0;
  CHECK(law.penalty() == Approx(2000.0));
  CHECK(law.friction_penalty() == Approx(1000.0));
  const Vector3d jump(-0.05, 0.004, -0.003), multiplier(100.0, 4.0, -3.0);
  const ContactLawValue value = contact_law(law, ContactStatus::sticking, multiplier, jump);
  CHECK(value.residual.norm() == Approx(0.0).margin(1e-12));
  CHECK(value.traction.isApprox(Vector3d(100.0, -4.0, 3.0), 1e-12));
}

TEST_CASE("Pointwise, tangents of a shear that slides are its derivatives once the multiplier is that shear") {
  ContactLaw law;
  law.augmentation = 900.0;
  law.friction = 0.3;
  law.friction_augmentation = 700.0;
  const Vector3d multiplier(100.0, 18.0, -24.0);  // at the limit of friction
  const Vector3d jump(-0.03, 0.06, -0.08);
  const ContactLawValue exact = contact_law(law, ContactStatus::sliding, multiplier, jump);
  law.pointwise = true;
  const ContactLawValue value = contact_law(law, ContactStatus::sliding, multiplier, jump);
  CHECK(value.residual == exact.residual);
  CHECK((value.traction_by_jump - exact.traction_by_jump).norm() < 1e-12 * exact.traction_by_jump.norm());
  CHECK((value.residual_by_multiplier - exact.residual_by_multiplier).norm() <
        1e-12 * exact.residual_by_multiplier.norm());

  // Without a shear yet, slip brings one along the slip too.
  const Vector3d none(100.0, 0.0, 0.0), slip(-0.03, 0.1, 0.0);
  CHECK(contact_law(law, ContactStatus::sliding, none, slip).traction_by_jump(1, 1) == Approx(-0.3 * 100.0 / 0.1));
}

TEST_CASE("A sliding point bears the limit of friction against the slip; a sticking one its shear") {
  ContactLaw law;
  law.friction = 0.5;
  const Vector3d multiplier(10.0, 5.0, 0.0);
  const ContactLawValue sliding = contact_law(law, ContactStatus::sliding, multiplier, Vector3d(0.0, 0.2, 0.0));
  CHECK(sliding.traction[0] == exactly(10.0));
  CHECK(sliding.traction[1] == exactly(-5.0));
  CHECK(sliding.residual.norm() == Approx(0.0).margin(1e-15));
  const ContactLawValue sticking =
      contact_law(law, ContactStatus::sticking, Vector3d(10.0, 3.0, 1.0), Vector3d::Zero());
  CHECK(sticking.traction[1] == exactly(-3.0));
  CHECK(sticking.residual.norm() == Approx(0.0).margin(1e-15));
}

TEST_CASE("By shares a shear is a share of the limit of friction, whatever the pressure of their unit") {
  ContactLaw law;
  law.friction = 0.5;
  law.friction_augmentation = 20.0;
  const Vector3d jump(0.0, 0.1, 0.0);
  for (const double pressure : {1.0, 40.0}) {
    law.share_pressure = pressure;
    law.friction_penalised = false;
    const Vector3d whole(10.0, law.friction * pressure, 0.0);
    CHECK(contact_law(law, ContactStatus::sliding, whole, jump).traction[1] == exactly(-5.0));
    CHECK(contact_law(law, ContactStatus::sliding, whole, jump).residual.tail<2>().norm() == Approx(0.0).margin(1e-14));
    CHECK(contact_law(law, ContactStatus::sticking, 0.5 * whole + Vector3d(5, 0, 0), Vector3d::Zero()).traction[1] ==
          exactly(-2.5));
    // A penalty of 0.4 of the limit a unit of slip.
    law.friction_penalised = true;
    law.friction_augmentation = 0.4 * law.friction * pressure;
    CHECK(contact_law(law, ContactStatus::sticking, whole, jump).traction[1] == exactly(-0.04 * 5.0));
    CHECK(contact_status(law, false, whole, jump) == ContactStatus::sticking);
    CHECK(contact_status(law, false, whole, 30.0 * jump) == ContactStatus::sliding);
  }
}

TEST_CASE(
    "The limit of friction is that of the multiplier, an overlap or not; of the depth where a penalty presses on a "
    "node") {
  ContactLaw law;
  law.friction = 0.5;
  const Vector3d overlapping(-0.2, 0.3, 0.4);
  CHECK(contact_law(law, ContactStatus::sliding, Vector3d(10, 3, 4), overlapping).traction.tail<2>().norm() ==
        exactly(5.0));
  CHECK(contact_status(law, false, Vector3d(10, 4.9, 0), Vector3d(-0.2, 0, 0)) == ContactStatus::sticking);
  CHECK(contact_status(law, false, Vector3d(10, 5.1, 0), Vector3d(-0.2, 0, 0)) == ContactStatus::sliding);
  law.penalised = true;
  CHECK(contact_law(law, ContactStatus::sliding, Vector3d(10, 3, 4), overlapping).traction.tail<2>().norm() ==
        exactly(5.0));
  law.pointwise = true;
  CHECK(contact_law(law, ContactStatus::sliding, Vector3d(10, 3, 4), overlapping).traction.tail<2>().norm() ==
        exactly(10.0));
}

TEST_CASE("Shares that any pressure weighs: a pull rubs the other way, and the weight has no derivative") {
  ContactLaw law;
  law.augmentation = 900.0;
  law.friction = 0.3;
  law.friction_augmentation = 700.0;
  law.share_pressure = 80.0;
  law.weighs_any_pressure = true;
  const Vector3d pressing(100.0, 7.0, 12.0), pulling(-100.0, 7.0, 12.0), jump(0.0, 0.02, 0.05);
  for (const ContactStatus status : {ContactStatus::sliding, ContactStatus::sticking}) {
    const auto value = [&](const Vector3d& multiplier, const Vector3d& at) {
      return contact_law(law, status, multiplier, at);
    };
    CAPTURE(static_cast<int>(status));
    CHECK((value(pulling, jump).traction + value(pressing, jump).traction).norm() <= 1e-13);
    CHECK((value(pulling, jump).residual + value(pressing, jump).residual).tail<2>().norm() <= 1e-15);
    CHECK(value(pulling, jump).residual_by_multiplier.col(0).tail<2>().isZero(0.0));
    // With the weight of the pressure held, a law that looks at pushes alone has the same derivatives.
    ContactLaw plain = law;
    plain.weighs_any_pressure = false;
    ContactLawValue same = contact_law(plain, status, pressing, jump);
    same.residual_by_multiplier.col(0).tail<2>().setZero();
    const ContactLawValue own = value(pressing, jump);
    CHECK(own.traction.isApprox(same.traction, 1e-14));
    CHECK(own.residual.isApprox(same.residual, 1e-14));
    CHECK(own.traction_by_multiplier.isApprox(same.traction_by_multiplier, 1e-14));
    CHECK(own.traction_by_jump.isApprox(same.traction_by_jump, 1e-14));
    CHECK(own.residual_by_multiplier.isApprox(same.residual_by_multiplier, 1e-14));
    CHECK(own.residual_by_jump.isApprox(same.residual_by_jump, 1e-14));
  }
}

TEST_CASE("Under a penalty a point between nodes that press on it stays closed across a small gap") {
  ContactLaw law;
  law.penalised = true;
  const Vector3d pressed(10, 0, 0), near(0.09, 0, 0), far(0.11, 0, 0);  // the penalty is 100
  CHECK(contact_status(law, false, pressed, near) != ContactStatus::open);
  CHECK(contact_law(law, ContactStatus::sliding, pressed, near).traction[0] == exactly(-9.0));
  CHECK(contact_status(law, false, pressed, far) == ContactStatus::open);
  CHECK(contact_status(law, false, -pressed, -near) == ContactStatus::open);
  law.opens_by_gap = true;
  CHECK(contact_status(law, false, pressed, near) == ContactStatus::open);
  law.opens_by_gap = false;
  law.pointwise = true;
  CHECK(contact_status(law, false, pressed, near) == ContactStatus::open);
}

TEST_CASE("Statuses: an overlap closes, a pull opens, a shear below the limit sticks") {
  ContactLaw law;
  law.friction = 0.5;
  CHECK(contact_status(law, false, Vector3d::Zero(), Vector3d(0.1, 0, 0)) == ContactStatus::open);
  CHECK(contact_status(law, false, Vector3d(-1, 0, 0), Vector3d::Zero()) == ContactStatus::open);
  CHECK(contact_status(law, true, Vector3d(-1, 0, 0), Vector3d::Zero()) != ContactStatus::open);
  CHECK(contact_status(law, false, Vector3d::Zero(), Vector3d(-0.1, 0, 0)) == ContactStatus::sticking);
  CHECK(contact_status(law, false, Vector3d(10, 4.9, 0), Vector3d::Zero()) == ContactStatus::sticking);
  CHECK(contact_status(law, false, Vector3d(10, 3, 4.1), Vector3d::Zero()) == ContactStatus::sliding);
}
