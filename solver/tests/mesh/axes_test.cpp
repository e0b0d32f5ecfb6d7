#include "solver/mesh/axes.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

TEST_CASE("cylindrical axes point away from the axis, round it and along it", "[mesh]") {
  const Eigen::Matrix3d axes = cylindrical_axes(0.0, -std::acos(0.0), {1, 2, 3}, {1, 7, 50});  // axis along +Z
  CHECK((axes.row(0) - Eigen::RowVector3d(0, 1, 0)).norm() < 1e-14);
  CHECK((axes.row(1) - Eigen::RowVector3d(-1, 0, 0)).norm() < 1e-14);
  CHECK((axes.row(2) - Eigen::RowVector3d(0, 0, 1)).norm() < 1e-14);
  CHECK_THROWS_AS(cylindrical_axes(0.0, -std::acos(0.0), {1, 2, 3}, {1, 2, 50}), Error);
}

TEST_CASE("a material round an axis has L away from it in the plane, and along it in space", "[mesh]") {
  const Eigen::Matrix3d around = cylindrical_axes(0.0, -std::acos(0.0), {1, 2, 3}, {1, 7, 50});
  CHECK(material_axes_round(around, false) == around);
  const Eigen::Matrix3d axes = material_axes_round(around, true);
  CHECK((axes.row(0) - Eigen::RowVector3d(0, 0, 1)).norm() < 1e-14);
  CHECK((axes.row(1) - Eigen::RowVector3d(-1, 0, 0)).norm() < 1e-14);
  CHECK((axes.row(2) - Eigen::RowVector3d(0, -1, 0)).norm() < 1e-14);
  CHECK(axes.determinant() == exactly(1.0));
}

TEST_CASE("Euler's angles turn about Z, the new X and the new Z", "[mesh]") {
  const double right = std::acos(0.0);
  CHECK((euler_axes(0.3, 0.0, 0.4) - nautical_axes(0.7, 0.0, 0.0)).norm() < 1e-15);
  // X goes to Y, Z goes round the new X (= Y) to X; the last turn brings the first axis to the second's place.
  const Eigen::Matrix3d axes = euler_axes(right, right, right);
  CHECK((axes.row(2) - Eigen::RowVector3d(1, 0, 0)).norm() < 1e-15);
  CHECK((axes.row(0) - Eigen::RowVector3d(0, 0, 1)).norm() < 1e-15);
  CHECK((axes.row(1) - Eigen::RowVector3d(0, -1, 0)).norm() < 1e-15);
}
