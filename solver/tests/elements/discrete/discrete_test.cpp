#include <cmath>
#include <span>
#include <tuple>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/linear/symmetric_eigen.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace discrete_test {

std::shared_ptr<Mesh> segment(const Point& from, const Point& to) {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {from, to};
  mesh->add_cell(CellType::seg2, std::array{0, 1});
  return mesh;
}

Body spring(const std::shared_ptr<Mesh>& mesh, Formulation formulation, std::span<const double> values,
            DiscreteFrame frame) {
  ElementProperties properties;
  properties.discrete[0] = diagonal_stiffness(*mesh, 0, formulation, values, frame);
  return Body(mesh, {formulation}, nullptr, properties);
}

TEST_CASE("a spring along a slanted segment resists along it with its first value, across it with the second",
          "[elements]") {
  const auto mesh = segment({1, 1, 0}, {4, 5, 0});  // direction (0.6, 0.8)
  const Body body = spring(mesh, Formulation::spring_2d, std::array{100.0, 7.0}, DiscreteFrame::local);
  Eigen::Vector4d stretch(0, 0, 0.6, 0.8);
  Eigen::Vector4d across(0, 0, -0.8, 0.6);
  CHECK((body.assembler->internal_forces(stretch) - Eigen::Vector4d(-60, -80, 60, 80)).norm() < 1e-12);
  CHECK((body.assembler->internal_forces(across) - Eigen::Vector4d(5.6, -4.2, -5.6, 4.2)).norm() < 1e-12);
  const ElementField force = body.assembler->stresses(stretch);
  CHECK(force.components == std::vector<std::string>{"N", "VY"});
  CHECK(force.at(0, 0, 0) == exactly(100.0));  // tension is positive
  CHECK(force.at(0, 0, 1) == Approx(0.0).margin(1e-12));
}

TEST_CASE("a spring in global axes ignores the direction of its segment", "[elements]") {
  const Body body =
      spring(segment({0, 0, 0}, {0, 5, 0}), Formulation::spring_2d, std::array{10.0, 3.0}, DiscreteFrame::global);
  const Eigen::Vector4d u(0, 0, 1, 1);
  CHECK((body.assembler->internal_forces(u) - Eigen::Vector4d(-10, -3, 10, 3)).norm() == 0.0);
}

TEST_CASE("own axes of segments are right-handed, the first along the segment, the second horizontal", "[elements]") {
  for (const Point& to : {Point{1, 2, 3}, Point{0, 0, 2}, Point{0, 0, -1}, Point{-1, 0, 0}}) {
    const Eigen::Matrix3d axes = own_axes(*segment({0, 0, 0}, to), 0);
    CHECK((axes * axes.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-15);
    CHECK(axes.determinant() == exactly(1.0));
    CHECK((axes.row(0).transpose() - Eigen::Vector3d(to[0], to[1], to[2]).normalized()).norm() < 1e-15);
    CHECK(axes(1, 2) == 0.0);
  }
  CHECK_THROWS_AS(own_axes(*segment({1, 1, 1}, {1, 1, 1}), 0), Error);
  // Coordinates that are rounding turn nothing.
  for (const Point& lean : {Point{0, 1e-16, 0}, Point{-3e-12, 0, 0}, Point{1e-17, -1e-16, 0}}) {
    for (const double way : {1.0, -1.0})
      CHECK(own_axes(*segment({0, 0, 0}, {lean[0], lean[1], 2 * way}), 0, 0.3) ==
            own_axes(*segment({0, 0, 0}, {0, 0, 2 * way}), 0, 0.3));
  }
}

TEST_CASE("springs in space with rotations keep their energy under a change of frame", "[elements]") {
  const std::array values = {11.0, 12.0, 13.0, 14.0, 15.0, 16.0};
  const auto mesh = segment({0, 0, 0}, {1, 2, 2});
  const Body local = spring(mesh, Formulation::spring_rotation_3d, values, DiscreteFrame::local);
  const Body global = spring(mesh, Formulation::spring_rotation_3d, values, DiscreteFrame::global);
  const Eigen::VectorXd a = symmetric_eigen(local.dense_stiffness()).values;
  const Eigen::VectorXd b = symmetric_eigen(global.dense_stiffness()).values;
  CHECK((a - b).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(a.head(6).cwiseAbs().maxCoeff() < 1e-12);  // both ends moving together cost nothing
}

TEST_CASE("a full symmetric stiffness is read by columns of its upper triangle", "[elements]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}};
  mesh->add_cell(CellType::poi1, std::array{0});
  const auto k = symmetric_stiffness(*mesh, 0, Formulation::spring_3d, std::array{1.0, 2.0, 3.0, 4.0, 5.0, 6.0},
                                     DiscreteFrame::local);
  const Eigen::Matrix3d expected = (Eigen::Matrix3d() << 1, 2, 4, 2, 3, 5, 4, 5, 6).finished();
  CHECK(k.matrix == expected);
}

TEST_CASE("a wrong number of values says how many there should be", "[elements]") {
  const auto mesh = segment({0, 0, 0}, {1, 0, 0});
  CHECK_THROWS_WITH(
      diagonal_stiffness(*mesh, 0, Formulation::spring_2d, std::array{1.0, 2.0, 3.0}, DiscreteFrame::local),
      Catch::Contains("takes 2 values, not 3"));
}

TEST_CASE("the roll towards a direction turns the second own axis to its side", "[elements]") {
  const auto mesh = segment({0, 0, 0}, {1, 2, 3});
  const Eigen::Vector3d wanted(0.3, -1.0, 0.2);
  const Eigen::Matrix3d axes = own_axes(*mesh, 0, roll_towards(*mesh, 0, wanted));
  CHECK(axes.row(1).dot(wanted) > 0.0);
  CHECK(axes.row(2).dot(wanted) == Approx(0.0).margin(1e-15));
  CHECK_THROWS_AS(roll_towards(*mesh, 0, {2, 4, 6}), Error);
  CHECK_THROWS_AS(axes_along({1, 0, 0}, {-2, 0, 0}), Error);
  CHECK((axes_along({0, 2, 0}, {-1, 1, 0}) - (Eigen::Matrix3d() << 0, 1, 0, -1, 0, 0, 0, 0, 1).finished()).norm() ==
        0.0);
}

TEST_CASE("points and segments without length take the axes that they are given", "[elements]") {
  auto point = std::make_shared<Mesh>();
  point->nodes = {{0, 0, 0}};
  point->add_cell(CellType::poi1, std::array{0});
  const Orientation quarter{.roll = 0.0, .point_axes = axes_along({0, 1, 0}, {-1, 0, 0})};
  for (const auto& mesh : {point, segment({1, 1, 1}, {1, 1, 1})}) {
    CHECK_FALSE(has_direction(*mesh, 0));
    const auto k =
        diagonal_stiffness(*mesh, 0, Formulation::spring_3d, std::array{5.0, 7.0, 9.0}, DiscreteFrame::local, quarter);
    CHECK((k.matrix.topLeftCorner<3, 3>() - Eigen::Vector3d(7, 5, 9).asDiagonal().toDenseMatrix()).norm() < 1e-14);
  }
}

TEST_CASE("a segment no longer than is asked for takes the axes that it is given, a longer one its own", "[elements]") {
  const auto mesh = segment({1, 1, 1}, {1, 1, 1 + 1e-7});
  const Orientation given{.roll = 0.0, .point_axes = axes_along({0, 1, 0}, {-1, 0, 0}), .no_length = 1e-6};
  CHECK_FALSE(has_direction(*mesh, 0, given.no_length));
  CHECK((discrete_axes(*mesh, 0, given) - given.point_axes).norm() == 0.0);
  Orientation strict = given;
  strict.no_length = 1e-8;
  CHECK((discrete_axes(*mesh, 0, strict).row(0) - Eigen::RowVector3d(0, 0, 1)).norm() < 1e-12);
}

TEST_CASE("forces come in own axes whatever the frame of the stiffness", "[elements]") {
  const Body body =
      spring(segment({0, 0, 0}, {3, 4, 0}), Formulation::spring_2d, std::array{10.0, 10.0}, DiscreteFrame::global);
  const ElementField force = body.assembler->stresses(Eigen::Vector4d(0, 0, 0.6, 0.8));
  CHECK(force.at(0, 0, 0) == exactly(10.0));
  CHECK(force.at(0, 0, 1) == Approx(0.0).margin(1e-14));
}

TEST_CASE("a full mass is read as a full stiffness is", "[elements]") {
  const auto mesh = segment({0, 0, 0}, {1, 2, 2});
  std::vector<double> values(21);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.0 + static_cast<double>(i);
  for (const auto frame : {DiscreteFrame::local, DiscreteFrame::global}) {
    CHECK(symmetric_mass(*mesh, 0, Formulation::spring_3d, values, frame) ==
          symmetric_stiffness(*mesh, 0, Formulation::spring_3d, values, frame).matrix);
  }
}

TEST_CASE("an unsymmetric stiffness is read by columns, and turned into global axes", "[elements]") {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes = {{0, 0, 0}};
  mesh->add_cell(CellType::poi1, std::array{0});
  const Orientation quarter{.roll = 0.0, .point_axes = axes_along({0, 1, 0}, {-1, 0, 0})};  // x' = Y, y' = -X
  const auto own = unsymmetric_stiffness(*mesh, 0, Formulation::spring_2d, std::array{1.0, 2.0, 3.0, 4.0},
                                         DiscreteFrame::global, quarter);
  CHECK(own.matrix == (Eigen::Matrix2d() << 1, 3, 2, 4).finished());
  const auto turned = unsymmetric_stiffness(*mesh, 0, Formulation::spring_2d, std::array{1.0, 2.0, 3.0, 4.0},
                                            DiscreteFrame::local, quarter);
  CHECK((turned.matrix - (Eigen::Matrix2d() << 4, -2, -3, 1).finished()).norm() < 1e-15);
  CHECK_THROWS_WITH(
      unsymmetric_stiffness(*mesh, 0, Formulation::spring_2d, std::array{1.0, 2.0, 3.0}, DiscreteFrame::global),
      Catch::Contains("takes 4 values, not 3"));
}

TEST_CASE("symmetric and skew part of an unsymmetric spring are together the derivative of its forces", "[elements]") {
  ElementProperties properties;
  const auto mesh = segment({0, 0, 0}, {3, 4, 0});
  std::vector<double> values(16);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(3.0 * static_cast<double>(i));
  properties.discrete[0] = unsymmetric_stiffness(*mesh, 0, Formulation::spring_2d, values, DiscreteFrame::local);
  const Body body(mesh, {Formulation::spring_2d}, nullptr, properties);
  CHECK_FALSE(body.assembler->is_symmetric());
  const Eigen::MatrixXd tangent = full_matrix(body.assembler->stiffness(Eigen::VectorXd::Zero(4)),
                                              body.assembler->skew_stiffness(Eigen::VectorXd::Zero(4)));
  for (int i = 0; i < 4; ++i)
    CHECK((tangent.col(i) - body.assembler->internal_forces(Eigen::VectorXd::Unit(4, i))).norm() < 1e-15);
}

TEST_CASE("a model of symmetric elements has no skew part", "[elements]") {
  const Body body =
      spring(segment({0, 0, 0}, {1, 0, 0}), Formulation::spring_2d, std::array{10.0, 3.0}, DiscreteFrame::local);
  CHECK(body.assembler->is_symmetric());
  CHECK(body.assembler->skew_stiffness(Eigen::VectorXd::Zero(4)).nonZeros() == 0);
}

TEST_CASE("springs that go on softer keep the forces that they had, and have new ones for what moves from there",
          "[elements]") {
  const auto slope = segment({1, 1, 0}, {4, 5, 0});
  auto point = std::make_shared<Mesh>();
  point->nodes = {{0, 0, 0}};
  point->add_cell(CellType::poi1, std::array{0});
  std::vector<double> uneven(16);  // forces at both ends are not alike
  for (std::size_t i = 0; i < uneven.size(); ++i) uneven[i] = std::sin(3.0 * static_cast<double>(i));
  const std::array values = {11.0, 12.0, 13.0, 14.0, 15.0, 16.0};
  const std::span first(values);
  using F = Formulation;
  constexpr auto local = DiscreteFrame::local;
  const std::vector<std::tuple<std::shared_ptr<Mesh>, F, DiscreteStiffness>> springs = {
      {slope, F::spring_2d, diagonal_stiffness(*slope, 0, F::spring_2d, first.first(2), local)},
      {slope, F::spring_rotation_2d, diagonal_stiffness(*slope, 0, F::spring_rotation_2d, first.first(3), local)},
      {slope, F::spring_3d, diagonal_stiffness(*slope, 0, F::spring_3d, first.first(3), local)},
      {slope, F::spring_rotation_3d, diagonal_stiffness(*slope, 0, F::spring_rotation_3d, first, local)},
      {point, F::spring_rotation_3d, diagonal_stiffness(*point, 0, F::spring_rotation_3d, first, local)},
      {slope, F::spring_2d, unsymmetric_stiffness(*slope, 0, F::spring_2d, uneven, local)}};
  for (const auto& [mesh, formulation, stiff] : springs) {
    ElementProperties before, after;
    before.discrete[0] = after.discrete[0] = stiff;
    after.discrete[0].matrix *= 0.25;
    const Body hard(mesh, {formulation}, nullptr, before);
    const Body soft(mesh, {formulation}, nullptr, after);
    Eigen::VectorXd u = hard.zero();
    for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = std::cos(2.0 * static_cast<double>(i));
    const Eigen::VectorXd forces = hard.assembler->internal_forces(u);
    const ElementField stresses = hard.assembler->stresses(u);
    soft.assembler->resume(u, &stresses, nullptr);
    CHECK((soft.assembler->internal_forces(u) - forces).norm() < 1e-14 * forces.norm());
    CHECK((soft.assembler->internal_forces(3.0 * u) - 1.5 * forces).norm() < 1e-14 * forces.norm());
    const std::vector<double> kept = soft.assembler->stresses(u).values;
    for (std::size_t k = 0; k < kept.size(); ++k) CHECK(kept[k] == Approx(stresses.values[k]).margin(1e-12));
  }
}

}  // namespace discrete_test
