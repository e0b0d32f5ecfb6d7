#include "solver/materials/contact_spring.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

const ContactSpring spring{.normal = 10.0, .tangential = 4.0, .friction = 0.3};

Eigen::Vector3d force_at(const Eigen::Vector3d& at, const Eigen::Vector2d& slip) {
  return respond(spring, at[0], at.tail<2>(), slip).force;
}

}  // namespace

TEST_CASE("a contact spring keeps its shear within the cone of friction", "[materials]") {
  const Eigen::Vector2d slip(0.1, -0.2);
  for (const double gap : {-0.5, -0.05, 0.0}) {
    for (const double side : {-1.0, -0.2, 0.1, 0.15, 2.0}) {
      const auto response = respond(spring, gap, {side, 0.3 * side}, slip);
      const double bound = -spring.friction * response.force[0];
      CHECK(response.force[0] == spring.normal * gap);
      CHECK(response.force.tail<2>().norm() <= bound * (1 + 1e-12));
      // The force is the elastic one of what has not slipped, in any case.
      CHECK(
          (response.force.tail<2>() - spring.tangential * (Eigen::Vector2d(side, 0.3 * side) - response.slip)).norm() <=
          1e-14);
      if (response.status == ContactSpringStatus::slipping)
        CHECK(response.force.tail<2>().norm() == Approx(bound).margin(1e-14));
    }
  }
}

TEST_CASE("an open contact spring pushes nothing and forgets where it stuck", "[materials]") {
  const auto response = respond(spring, 1e-9, {0.7, -0.4}, {0.0, 0.0});
  CHECK(response.status == ContactSpringStatus::open);
  CHECK(response.force.isZero(0.0));
  CHECK(response.slip == Eigen::Vector2d(0.7, -0.4));
}

TEST_CASE("the tangent of a contact spring is the derivative of its force", "[materials]") {
  constexpr double h = 1e-6;
  for (const Eigen::Vector3d& at :
       {Eigen::Vector3d(-0.4, 0.2, -0.1), Eigen::Vector3d(-0.1, 0.5, 0.3), Eigen::Vector3d(0.2, 0.5, 0.3)}) {
    const auto response = respond(spring, at[0], at.tail<2>(), {0.05, 0.0});
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
      const Eigen::Vector3d column = (force_at(at + step, {0.05, 0.0}) - force_at(at - step, {0.05, 0.0})) / (2 * h);
      CHECK((column - response.tangent.col(k)).norm() <= 1e-8);
    }
  }
}
