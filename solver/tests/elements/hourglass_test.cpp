#include "solver/elements/hourglass.hpp"

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace hourglass_test {

/// The reference cell stretched along the axes, and then each node moved by up to `bend` of a half edge.
Hourglass::Places box(const Eigen::Vector3d& half_edges, double bend = 0.0) {
  Hourglass::Places places;
  const auto corners = reference_nodes(CellType::hexa8);
  for (int a = 0; a < 8; ++a)
    for (int c = 0; c < 3; ++c) places(a, c) = half_edges[c] * (corners[static_cast<std::size_t>(a)][static_cast<std::size_t>(c)] + bend * std::sin(3.0 * a + 1.7 * c));
  return places;
}

constexpr double young = 1000.0, poisson = 0.3;
const Matrix6d law = solid_stiffness(IsotropicModuli{young, poisson});

TEST_CASE("Linear displacements have no hourglass pattern, on distorted cells too") {
  const Hourglass::Places places = box({1.0, 2.0, 0.5}, 0.1);
  const Hourglass hourglass(places);
  Eigen::Matrix3d gradient;
  gradient << 0.3, -1.0, 0.4, 0.2, 0.7, -0.6, 1.1, 0.5, -0.2;
  const Hourglass::Places linear = (places * gradient.transpose()).rowwise() + Eigen::RowVector3d(1.0, -2.0, 3.0);
  CHECK(hourglass.amplitudes(linear).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("A box bent in a plane is as stiff as a plate of its material, about each of its axes") {
  // The pattern xi eta along x: a strain y / (a b) along x that nothing hinders across the plate, and everything along z.
  const double a = 2.0, b = 0.5, c = 1.5;
  const Hourglass hourglass(box({a, b, c}));
  const Hourglass::Stiffness stiffness = hourglass.stiffness(law, Hourglass::Projection::bending);
  const double second_moment = 2 * a * 2 * c * 2.0 / 3.0 * b * b * b;  // the integral of y^2
  CHECK(stiffness(6, 6) == exactly(young / (1 - poisson * poisson) * second_moment / (a * a * b * b)));
  // Along y the same pattern has the strain x / (a b).
  CHECK(stiffness(7, 7) == exactly(young / (1 - poisson * poisson) * (2 * b * 2 * c * 2.0 / 3.0 * a * a * a) / (a * a * b * b)));
  CHECK((stiffness - stiffness.transpose()).norm() < 1e-12 * stiffness.norm());
}

TEST_CASE("Without change of volume the stiffness does not know the bulk modulus, and is soft") {
  const Hourglass hourglass(box({1.0, 1.0, 1.0}));
  const auto stiffness = [&](double nu) { return hourglass.stiffness(solid_stiffness(IsotropicModuli{2.0 * (1.0 + nu), nu}), Hourglass::Projection::deviatoric); };
  CHECK((stiffness(0.1) - stiffness(0.49)).norm() < 1e-12 * stiffness(0.1).norm());  // of the same shear modulus
}

TEST_CASE("Forces on patterns do work on them alone") {
  const Hourglass hourglass(box({1.0, 2.0, 0.5}, 0.1));
  Hourglass::Patterns forces;
  forces << 1, 2, 3, -1, 0.5, 2, 0, 1, -2, 4, 1, 1;
  const Hourglass::Places moved = box({0.3, -0.2, 0.7}, 0.4);
  CHECK(hourglass.nodal_forces(forces).cwiseProduct(moved).sum() == exactly(forces.cwiseProduct(hourglass.amplitudes(moved)).sum()));
}

}  // namespace hourglass_test
