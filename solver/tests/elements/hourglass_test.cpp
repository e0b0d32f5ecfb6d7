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
    for (int c = 0; c < 3; ++c)
      places(a, c) = half_edges[c] * (corners[static_cast<std::size_t>(a)][static_cast<std::size_t>(c)] +
                                      bend * std::sin(3.0 * a + 1.7 * c));
  return places;
}

using Vector6d = Eigen::Matrix<double, 6, 1>;

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
  // The pattern xi eta along x: a strain y / (a b) along x that nothing hinders across the plate, and everything along
  // z.
  const double a = 2.0, b = 0.5, c = 1.5;
  const Hourglass hourglass(box({a, b, c}));
  const Hourglass::Stiffness stiffness = hourglass.stiffness(law, Hourglass::Projection::bending);
  const double second_moment = 2 * a * 2 * c * 2.0 / 3.0 * b * b * b;  // the integral of y^2
  CHECK(stiffness(6, 6) == exactly(young / (1 - poisson * poisson) * second_moment / (a * a * b * b)));
  // Along y the same pattern has the strain x / (a b).
  CHECK(stiffness(7, 7) ==
        exactly(young / (1 - poisson * poisson) * (2 * b * 2 * c * 2.0 / 3.0 * a * a * a) / (a * a * b * b)));
  CHECK((stiffness - stiffness.transpose()).norm() < 1e-12 * stiffness.norm());
}

TEST_CASE("Without change of volume the stiffness does not know the bulk modulus, and is soft") {
  const Hourglass hourglass(box({1.0, 1.0, 1.0}));
  const auto stiffness = [&](double nu) {
    return hourglass.stiffness(solid_stiffness(IsotropicModuli{2.0 * (1.0 + nu), nu}),
                               Hourglass::Projection::deviatoric);
  };
  CHECK((stiffness(0.1) - stiffness(0.49)).norm() < 1e-12 * stiffness(0.1).norm());  // of the same shear modulus
}

using Stiffness = Eigen::Matrix<double, 24, 24>;

Stiffness stiffness_of(const Hourglass::Places& places, Hourglass::Projection projection,
                       const Matrix6d& of_law = law) {
  const Hourglass hourglass(places);
  return hourglass.nodal_stiffness(hourglass.stiffness(of_law, projection));
}

TEST_CASE("A distorted cell is as stiff from whichever corner its nodes are numbered") {
  const Hourglass::Places places = box({1.0, 2.0, 0.5}, 0.1);
  const std::array numberings = {std::array{1, 2, 3, 0, 5, 6, 7, 4}, std::array{0, 3, 7, 4, 1, 2, 6, 5},
                                 std::array{5, 4, 7, 6, 1, 0, 3, 2}};
  for (const auto projection : {Hourglass::Projection::bending, Hourglass::Projection::deviatoric}) {
    const Stiffness first = stiffness_of(places, projection);
    for (const auto& nodes : numberings) {
      Hourglass::Places renumbered;
      for (int a = 0; a < 8; ++a) renumbered.row(a) = places.row(nodes[static_cast<std::size_t>(a)]);
      const Stiffness other = stiffness_of(renumbered, projection);
      double apart = 0.0;
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b)
          apart = std::max(
              apart, (other.block<3, 3>(3 * a, 3 * b) -
                      first.block<3, 3>(3 * nodes[static_cast<std::size_t>(a)], 3 * nodes[static_cast<std::size_t>(b)]))
                         .norm());
      CHECK(apart < 1e-12 * first.norm());
    }
  }
}

TEST_CASE("A cell that is turned has its stiffness turned, also where its material flows in one direction") {
  const Hourglass::Places places = box({1.0, 2.0, 0.5}, 0.1);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  Vector6d flow;
  flow << 2.0, -1.0, -1.0, 0.5, 0.3, -0.7;
  const Vector6d rises = law * flow;
  const Matrix6d tangent = law - 0.8 * rises * rises.transpose() / rises.dot(flow);
  const Matrix6d back = strain_rotation(turn.transpose());
  const Stiffness first = stiffness_of(places, Hourglass::Projection::deviatoric, tangent);
  const Stiffness turned =
      stiffness_of(places * turn.transpose(), Hourglass::Projection::deviatoric, back.transpose() * tangent * back);
  double apart = 0.0;
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < 8; ++b)
      apart = std::max(
          apart, (turned.block<3, 3>(3 * a, 3 * b) - turn * first.block<3, 3>(3 * a, 3 * b) * turn.transpose()).norm());
  CHECK(apart < 1e-12 * first.norm());
}

TEST_CASE("Forces on patterns do work on them alone") {
  const Hourglass hourglass(box({1.0, 2.0, 0.5}, 0.1));
  Hourglass::Patterns forces;
  forces << 1, 2, 3, -1, 0.5, 2, 0, 1, -2, 4, 1, 1;
  const Hourglass::Places moved = box({0.3, -0.2, 0.7}, 0.4);
  CHECK(hourglass.nodal_forces(forces).cwiseProduct(moved).sum() ==
        exactly(forces.cwiseProduct(hourglass.amplitudes(moved)).sum()));
}

}  // namespace hourglass_test
