#include "solver/fields/data/rotation.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "solver/mesh/axes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

Mesh nodes_at(std::vector<Point> nodes) {
  Mesh mesh;
  mesh.nodes = std::move(nodes);
  return mesh;
}

}  // namespace

TEST_CASE("a tensor keeps its invariants in other axes, and its missing components come out", "[fields]") {
  const NodalField field{"SIEF_R", {"SIXX", "SIYY", "SIZZ", "SIXY"}, {4.0, -1.0, 2.0, 3.0}};
  const Eigen::Matrix3d axes = nautical_axes(0.4, -0.7, 1.1);
  const std::vector<int> nodes = {0};
  const NodalField turned = in_axes(field, nodes, [&](int) { return axes; });
  REQUIRE(turned.components.size() == 6);
  const auto at = [&](const char* name) { return turned.at(0, turned.component(name)); };
  CHECK(at("SIXX") + at("SIYY") + at("SIZZ") == exactly(5.0));
  const double norm = at("SIXX") * at("SIXX") + at("SIYY") * at("SIYY") + at("SIZZ") * at("SIZZ") +
                      2 * (at("SIXY") * at("SIXY") + at("SIXZ") * at("SIXZ") + at("SIYZ") * at("SIYZ"));
  CHECK(norm == exactly(16 + 1 + 4 + 2 * 9));
  CHECK(std::abs(at("SIXZ")) > 0.1);
}

TEST_CASE("forces and strains of sections lie in axes of their own", "[fields]") {
  const NodalField of_beam{"EPSI_R", {"EPXX", "GAXY", "KY"}, {1.0, 0.0, 0.0}},
      of_body{"EPSI_R", {"EPXX", "EPYY"}, {1.0, 0.0}};
  CHECK(has_own_axes(of_beam, "EPXX"));
  CHECK(has_own_axes(of_beam, "KY"));
  CHECK_FALSE(has_own_axes(of_body, "EPXX"));
  CHECK_FALSE(has_own_axes(of_body, "VMIS"));
}

TEST_CASE("a hoop stress stands in the third place of axes of revolution", "[fields]") {
  // At 30 degrees round Z, a stress of 5 along the tangent.
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  const Mesh mesh = nodes_at({{2 * c, 2 * s, 7.0}});
  const NodalField field{"SIEF_R", {"SIXX", "SIYY", "SIZZ", "SIXY"}, {5 * s * s, 5 * c * c, 0.0, -5 * s * c}};
  const std::vector<int> nodes = {0};
  const NodalField turned =
      in_axes(field, nodes, revolution_axes(mesh, Eigen::Vector3d::Zero(), 3 * Eigen::Vector3d::UnitZ()));
  CHECK(turned.at(0, turned.component("SIZZ")) == exactly(5.0));
  CHECK(turned.at(0, turned.component("SIXX")) == Approx(0.0).margin(1e-14));
  CHECK(turned.at(0, turned.component("SIYY")) == Approx(0.0).margin(1e-14));
}

TEST_CASE("the third axis of revolution turns as a screw along the axis does", "[fields]") {
  // At the point (2, 0, 0) about Z the turn goes along Y: a shear of XY is one between r and the turn, of the same
  // sign.
  const Mesh mesh = nodes_at({{2, 0, 0}});
  const NodalField field{"SIEF_R", {"SIXX", "SIYY", "SIZZ", "SIXY"}, {0.0, 0.0, 0.0, 5.0}};
  const std::vector<int> nodes = {0};
  const NodalField turned =
      in_axes(field, nodes, revolution_axes(mesh, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()));
  CHECK(turned.at(0, turned.component("SIXZ")) == exactly(5.0));
}

TEST_CASE("a node on the axis of revolution is named", "[fields]") {
  const Mesh mesh = nodes_at({{0, 0, 3}});
  const auto axes = revolution_axes(mesh, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ());
  CHECK_THROWS_WITH(axes(0), Catch::Contains("N1"));
}

TEST_CASE("a node on the axis of revolution may take the axes of its nearest neighbour", "[fields]") {
  const Mesh mesh = nodes_at({{0, 0, 3}, {0, 1, 3}, {5, 0, 3}});
  const std::vector<int> nodes = {0, 1, 2};
  const auto axes =
      with_axes_of_neighbours(mesh, nodes, revolution_axes(mesh, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()));
  CHECK(axes(0).row(0) == Eigen::RowVector3d::UnitY());
  CHECK(axes(2).row(0) == Eigen::RowVector3d::UnitX());
  const std::vector<int> alone = {0};
  CHECK_THROWS_WITH(
      with_axes_of_neighbours(mesh, alone, revolution_axes(mesh, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()))(0),
      Catch::Contains("N1"));
}

TEST_CASE("a resultant's moment moves with its point as the force says", "[fields]") {
  const Mesh mesh = nodes_at({{1, 0, 0}, {0, 2, 0}});
  const NodalField forces{"DEPL_R", {"DX", "DY", "DRZ"}, {0.0, 3.0, 0.5, 4.0, absent, absent}};
  const std::vector<int> nodes = {0, 1};
  const Resultant about_origin = resultant(mesh, forces, nodes, Eigen::Vector3d::Zero());
  CHECK(about_origin.force == Eigen::Vector3d(4, 3, 0));
  CHECK(about_origin.moment[2] == exactly(1 * 3 + 0.5 - 2 * 4));
  const Eigen::Vector3d point(2, -1, 5);
  const Resultant moved = resultant(mesh, forces, nodes, point);
  CHECK((moved.moment - (about_origin.moment - point.cross(about_origin.force))).norm() == Approx(0.0).margin(1e-14));
}

TEST_CASE("contact forces have a moment too", "[fields]") {
  const Mesh mesh = nodes_at({{1, 0, 0}, {0, 2, 0}});
  const NodalField forces{"DEPL_R", {"RN", "RX", "RY"}, {7.0, 0.0, 3.0, 7.0, 4.0, 0.0}};
  const std::vector<int> nodes = {0, 1};
  const Resultant about_origin = resultant(mesh, forces, nodes, Eigen::Vector3d::Zero(), {"RX", "RY", "RZ"});
  CHECK(about_origin.force == Eigen::Vector3d(4, 3, 0));
  CHECK(about_origin.moment[2] == exactly(1 * 3 - 2 * 4));
}

TEST_CASE("along a line the first axis is its tangent, at a corner between both segments", "[fields]") {
  Mesh mesh = nodes_at({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}});
  mesh.dimension = 2;
  const std::vector<int> line = {0, 1, 2};
  const auto axes = line_axes(mesh, line, std::nullopt);
  CHECK((axes(0) - Eigen::Matrix3d::Identity()).norm() < 1e-15);
  const double half = std::sqrt(0.5);
  CHECK((axes(1).row(0).transpose() - Eigen::Vector3d(half, half, 0)).norm() < 1e-15);
  CHECK((axes(1).row(1).transpose() - Eigen::Vector3d(-half, half, 0)).norm() < 1e-15);
  CHECK((axes(2).row(0).transpose() - Eigen::Vector3d(0, 1, 0)).norm() < 1e-15);
}

TEST_CASE("in space a line needs a second direction, which it makes square", "[fields]") {
  const Mesh mesh = nodes_at({{0, 0, 0}, {0, 0, 2}});
  const std::vector<int> line = {0, 1};
  CHECK_THROWS_WITH(line_axes(mesh, line, std::nullopt), Catch::Contains("second axis"));
  CHECK_THROWS_WITH(line_axes(mesh, line, Eigen::Vector3d(0, 0, 5)), Catch::Contains("along the line"));
  CHECK_THROWS_WITH(line_axes(mesh, std::vector<int>{0}, std::nullopt), Catch::Contains("one node"));
  const Eigen::Matrix3d axes = line_axes(mesh, line, Eigen::Vector3d(0, 3, 4))(0);
  CHECK((axes.row(1).transpose() - Eigen::Vector3d::UnitY()).norm() < 1e-15);
  CHECK(axes.determinant() == exactly(1.0));
}

TEST_CASE("polar axes lie in the plane of X and Y, the second clockwise", "[fields]") {
  const Mesh mesh = nodes_at({{0, 2, 5}, {0, 0, 1}});
  const auto axes = polar_axes(mesh);
  CHECK((axes(0).row(0).transpose() - Eigen::Vector3d::UnitY()).norm() < 1e-15);
  CHECK((axes(0).row(1).transpose() - Eigen::Vector3d::UnitX()).norm() < 1e-15);
  CHECK_THROWS_WITH(axes(1), Catch::Contains("N2"));
}
