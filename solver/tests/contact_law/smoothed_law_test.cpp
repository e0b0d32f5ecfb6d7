#include "solver/contact_law/smoothed_law.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/law_tangents.hpp"

using namespace comma::solver;
using Eigen::Vector3d;

namespace {

ContactLaw frictional_law() {
  ContactLaw law;
  law.augmentation = 900.0;
  law.friction = 0.3;
  law.friction_augmentation = 700.0;
  return law;
}

constexpr PointStiffness bodies{.normal = 400.0, .along = 250.0};

}  // namespace

TEST_CASE("Tangents of the smoothed law are its derivatives") {
  for (const bool penalised : {false, true})
    for (const double share_pressure : {0.0, 80.0})
      for (const bool stays_closed : {false, true})
        for (const bool rubs : {false, true})
          for (const bool on_node : {false, true})
            for (const double rounding : {1.0, 100.0}) {
              ContactLaw law = frictional_law();
              law.penalised = law.friction_penalised = penalised;
              law.share_pressure = share_pressure;
              const LawSmoothing smoothing{.pressure = rounding,
                                           .law_share = 0.5,
                                           .law_share_along = 0.25,
                                           .stays_closed = stays_closed,
                                           .rubs = rubs,
                                           .on_node = on_node};
              const auto value = [&](const Vector3d& multiplier, const Vector3d& jump) {
                return SmoothedLaw(law, bodies, smoothing).at(multiplier, jump);
              };
              CAPTURE(penalised, share_pressure, stays_closed, rubs, on_node, rounding);
              check_tangents(value);
              law.dead = Eigen::Vector2d(0.6, 0.8);
              check_tangents(value);
            }
}

TEST_CASE("Along a dead direction the smoothed law is that of a point without friction") {
  const Vector3d multiplier(100.0, 7.0, 12.0), jump(-0.03, 0.02, 0.05);
  for (const double share_pressure : {0.0, 80.0})
    for (const bool on_node : {false, true}) {
      ContactLaw law = frictional_law();
      law.share_pressure = share_pressure;
      const LawSmoothing smoothing{.pressure = 1.0, .law_share_along = 0.25, .rubs = true, .on_node = on_node};
      law.dead = Eigen::Vector2d::UnitY();
      const SmoothedLawValue value = SmoothedLaw(law, bodies, smoothing).at(multiplier, jump);
      law.friction = 0.0;
      const SmoothedLawValue smooth = SmoothedLaw(law, bodies, smoothing).at(multiplier, jump);
      CHECK(value.traction[2] == 0.0);
      CHECK(value.residual[2] == Approx(smooth.residual[2]).epsilon(1e-14));
      CHECK(std::abs(value.traction[1]) > 1.0);
    }
}

TEST_CASE("The less it is rounded off, the nearer the smoothed law is to that of its status") {
  const ContactLaw law = frictional_law();
  const Vector3d closed(-0.03, 0.0, 0.0), open(0.3, 0.0, 0.0), multiplier(120.0, 10.0, -4.0);
  for (const double slip : {0.0, 0.3})
    for (const Vector3d& gap : {closed, open}) {
      const Vector3d jump = gap + Vector3d(0.0, slip, 0.0);
      double last = 1.0;
      for (const double rounding : {1e-2, 1e-4}) {
        const SmoothedLaw smoothed(law, bodies, {.pressure = rounding, .rubs = true, .on_node = false});
        ContactLaw same = law;
        const ContactLawValue exact = contact_law(same, smoothed.status(multiplier, jump), multiplier, jump);
        const double off = (smoothed.at(multiplier, jump).residual - exact.residual).norm();
        CAPTURE(slip, gap[0], rounding, off);
        CHECK(off < 0.1 * last);
        last = off;
      }
    }
}
