#include "solver/nonlinear/iterations/known_forces.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace known_forces_test {

const Eigen::Matrix3d stiffness = Eigen::Vector3d(2.0, 3.0, 5.0).asDiagonal();

TEST_CASE("Forces after a move in proportion to an earlier one need no computation, after another one they do") {
  int computed = 0;
  const KnownForces::Compute compute = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    ++computed;
    return stiffness * u;
  };
  const Eigen::VectorXd push = Eigen::Vector3d(0.0, 0.1, 0.0), start = Eigen::Vector3d::Zero();
  const Eigen::VectorXd end = Eigen::Vector3d(0.3, 0.1, -0.2);  // of the first step
  KnownForces known;
  CHECK(known.after_move(start, push, compute) == stiffness * push);
  known.note(start, stiffness * start);
  known.after_move(start, push, compute);
  CHECK(computed == 2);
  known.note(end, stiffness * end);

  SECTION("in proportion") {
    const Eigen::VectorXd moved = end + 1.5 * push;
    CHECK((known.after_move(end, moved, compute) - stiffness * moved).norm() < 1e-15);
    CHECK(computed == 2);
  }
  SECTION("nothing has moved") {
    CHECK(known.after_move(end, end, compute) == stiffness * end);
    CHECK(computed == 2);
  }
  SECTION("another unknown") {
    const Eigen::VectorXd moved = end + Eigen::Vector3d(0.0, 0.1, 1e-9);
    CHECK(known.after_move(end, moved, compute) == stiffness * moved);
    CHECK(computed == 3);
  }
  SECTION("from elsewhere") {
    const Eigen::VectorXd moved = start + push;
    CHECK(known.after_move(start, moved, compute) == stiffness * moved);
    CHECK(computed == 3);
  }
}

}  // namespace known_forces_test
