#include "solver/elements/solids/hourglass.hpp"

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace hourglass_test {

/// The reference cell stretched along the axes, and then each node moved by up to `bend` of a half edge.
Hourglass::Places box(const Eigen::Vector3d& half_edges, double bend = 0.0) {
  Hourglass::Places places;
  const auto corners = reference_nodes(CellType::hexa8);
  for (int a = 0; a < 8; ++a)
    for (int c = 0; c < 3; ++c)
      places(a, c) = half_edges[c] * (corners[static_cast<std::size_t>(a)][static_cast<std::size_t>(c)] +
                                      bend * std::sin(3.0 * a + 1.7 * c));
  return places;
}

constexpr double young = 1000.0, poisson = 0.3;
const Matrix6d law = solid_stiffness(IsotropicModuli{young, poisson});

Hourglass bending(const Hourglass::Places& places) { return {places, Hourglass::Projection::bending, poisson}; }
Hourglass flowing(const Hourglass::Places& places) { return {places, Hourglass::Projection::deviatoric, 0.0}; }

/// The stiffness on displacements that are a pattern (1 to 4) along an axis.
double stiffness_of(const Hourglass& hourglass, int pattern, int axis, const Matrix6d& of_law = law) {
  Hourglass::Places moved = Hourglass::Places::Zero();
  const auto corners = reference_nodes(CellType::hexa8);
  for (int a = 0; a < 8; ++a) {
    const auto [r, s, t] = corners[static_cast<std::size_t>(a)];
    moved(a, axis) = std::array{s * t, r * t, r * s, r * s * t}[static_cast<std::size_t>(pattern - 1)];
  }
  const Eigen::Matrix<double, 24, 1> u = moved.reshaped<Eigen::RowMajor>();
  return u.dot(hourglass.stiffness(of_law) * u);
}

TEST_CASE("Linear displacements have no hourglass pattern, on distorted cells too") {
  const Hourglass::Places places = box({1.0, 2.0, 0.5}, 0.1);
  Eigen::Matrix3d gradient;
  gradient << 0.3, -1.0, 0.4, 0.2, 0.7, -0.6, 1.1, 0.5, -0.2;
  const Hourglass::Places linear = (places * gradient.transpose()).rowwise() + Eigen::RowVector3d(1.0, -2.0, 3.0);
  CHECK(bending(places).amplitudes(linear).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(flowing(places).amplitudes(linear).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("A box bent in a plane is as stiff as a plate of its material, about each of its axes") {
  // The pattern xi eta along x: a strain y / (a b) along x that nothing hinders across the plate, and everything along
  // z.
  const double a = 2.0, b = 0.5, c = 1.5;
  const Hourglass hourglass = bending(box({a, b, c}));
  const double second_moment = 2 * a * 2 * c * 2.0 / 3.0 * b * b * b;  // the integral of y^2
  CHECK(stiffness_of(hourglass, 3, 0) == exactly(young / (1 - poisson * poisson) * second_moment / (a * a * b * b)));
  // Along y the same pattern has the strain x / (a b).
  CHECK(stiffness_of(hourglass, 3, 1) ==
        exactly(young / (1 - poisson * poisson) * (2 * b * 2 * c * 2.0 / 3.0 * a * a * a) / (a * a * b * b)));
  CHECK((hourglass.stiffness(law) - hourglass.stiffness(law).transpose()).norm() <
        1e-12 * hourglass.stiffness(law).norm());
}

TEST_CASE("Without change of volume the stiffness does not know the bulk modulus, and is soft") {
  const auto stiffness = [&](double nu) {
    return flowing(box({1.0, 1.0, 1.0})).stiffness(solid_stiffness(IsotropicModuli{2.0 * (1.0 + nu), nu}));
  };
  CHECK((stiffness(0.1) - stiffness(0.49)).norm() < 1e-12 * stiffness(0.1).norm());  // of the same shear modulus
}

TEST_CASE("A cube that is twisted about an axis has twice the stiffness of its shears where it may flow") {
  // The pattern eta zeta along x on a cube of unit sides: shears 2 z and 2 y in two planes, the mean of whose squares
  // is 1/3.
  const double shear_modulus = young / (2 * (1 + poisson));
  const Hourglass::Places cube = box({0.5, 0.5, 0.5});
  CHECK(stiffness_of(bending(cube), 1, 0) == exactly(8.0 / 3.0 * shear_modulus));
  CHECK(stiffness_of(flowing(cube), 1, 0) == exactly(16.0 / 3.0 * shear_modulus));
}

TEST_CASE("A sheared cube that may flow has the figures of Code_Aster 17.3") {
  Eigen::Matrix3d shear;
  shear << 1.0, 0.3, 0.1, 0.0, 1.0, 0.2, 0.1, 0.0, 1.0;
  const Hourglass hourglass = flowing(box({0.5, 0.5, 0.5}) * shear.transpose());
  const auto figure = [](double value) { return Approx(value).epsilon(1e-8); };
  CHECK(stiffness_of(hourglass, 1, 0) == figure(2144.02911));
  CHECK(stiffness_of(hourglass, 1, 1) == figure(794.63152));
  CHECK(stiffness_of(hourglass, 2, 1) == figure(2099.20022));
  CHECK(stiffness_of(hourglass, 3, 2) == figure(2139.60114));
  CHECK(stiffness_of(hourglass, 4, 0) == figure(249.79691));
}

TEST_CASE("Forces and energy are those of the stiffness, on distorted cells too") {
  const Hourglass::Places places = box({1.0, 2.0, 0.5}, 0.1), moved = box({0.3, -0.2, 0.7}, 0.4);
  const Eigen::Matrix<double, 24, 1> u = moved.reshaped<Eigen::RowMajor>();
  const Eigen::Matrix3d middle = shape_derivatives(CellType::hexa8, {0.0, 0.0, 0.0}).transpose() * places;
  const Eigen::Matrix3d h =
      moved.transpose() * shape_derivatives(CellType::hexa8, {0.0, 0.0, 0.0}) * middle.inverse().transpose();
  Vector6d strain;
  strain << h(0, 0), h(1, 1), h(2, 2), h(0, 1) + h(1, 0), h(0, 2) + h(2, 0), h(1, 2) + h(2, 1);
  for (const Hourglass& hourglass : {bending(places), flowing(places)}) {
    const Hourglass::Stresses stresses = hourglass.stresses(law, hourglass.amplitudes(moved));
    const Eigen::Matrix<double, 24, 1> forces = hourglass.forces(stresses, law * strain).reshaped<Eigen::RowMajor>();
    CHECK((forces - hourglass.stiffness(law) * u).norm() < 1e-12 * forces.norm());
  }
  const Hourglass hourglass = bending(places);
  CHECK(hourglass.energy(law, hourglass.stresses(law, hourglass.amplitudes(moved)), law * strain) ==
        exactly(0.5 * u.dot(hourglass.stiffness(law) * u)));
}

}  // namespace hourglass_test
