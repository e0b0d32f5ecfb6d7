#include <catch2/catch.hpp>

#include "solver/fields/stresses/surface_stresses.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace surface_stresses_test {

double value(const ElementField& field, int cell, std::string_view name) {
  return field.at(cell, 0, field.component(name));
}

/// A unit cube (cell 0) with its top face (cell 1).
Mesh cube() {
  Mesh mesh;
  for (const auto& at : reference_nodes(CellType::hexa8)) mesh.nodes.push_back({at[0], at[1], at[2]});
  mesh.add_cell(CellType::hexa8, std::array{0, 1, 2, 3, 4, 5, 6, 7});
  mesh.add_cell(CellType::quad4, std::array{4, 5, 6, 7});
  return mesh;
}

TEST_CASE("a uniform stress on a face: normal and tangential traction, principal stresses within it", "[fields]") {
  const Mesh mesh = cube();
  ElementField stress{"SIEF_R", Support::element_node, {"SIXX", "SIYY", "SIZZ", "SIXY", "SIXZ", "SIYZ"}, {0, 8, 8}, {}};
  for (int i = 0; i < 8; ++i) stress.values.insert(stress.values.end(), {100, 200, 1000, 0, 50, -70});
  const ElementField skin = surface_stresses(mesh, stress, std::array{1});
  REQUIRE(skin.points(1) == 1);
  CHECK(skin.points(0) == 0);
  CHECK(value(skin, 1, "SIG_N") == exactly(1000));
  CHECK(value(skin, 1, "SIG_NZ") == exactly(1000));
  CHECK(value(skin, 1, "SIG_TX") == exactly(50));
  CHECK(value(skin, 1, "SIG_TY") == exactly(-70));
  CHECK(value(skin, 1, "SIG_TZ") == Approx(0).margin(1e-12));
  CHECK(value(skin, 1, "SIG_T1") == exactly(100));
  CHECK(value(skin, 1, "SIG_T2") == exactly(200));
  CHECK(std::abs(value(skin, 1, "SIG_T1X")) == exactly(100));
  CHECK(std::abs(value(skin, 1, "SIG_T2Y")) == exactly(200));
}

TEST_CASE("principal directions in a face take their signs from its first edge", "[fields]") {
  // The first edge of the top goes along X: s is -X, and t = n x s is -Y.
  const Mesh mesh = cube();
  const auto skin_of = [&](double xx, double yy, double xy) {
    ElementField stress{
        "SIEF_R", Support::element_node, {"SIXX", "SIYY", "SIZZ", "SIXY", "SIXZ", "SIYZ"}, {0, 8, 8}, {}};
    for (int i = 0; i < 8; ++i) stress.values.insert(stress.values.end(), {xx, yy, 0, xy, 0, 0});
    return surface_stresses(mesh, stress, std::array{1});
  };
  for (const double shear : {-8.0, -1e-9, 0.0, 1e-9, 8.0}) {
    const ElementField along_t = skin_of(3, 90, shear), along_s = skin_of(90, 3, shear);
    CHECK(value(along_t, 1, "SIG_T2Y") < 0.0);  // towards t
    CHECK(value(along_s, 1, "SIG_T1Y") > 0.0);  // away from t
    // Along s as the shear is, but for a shear that is rounding.
    CHECK(value(along_t, 1, "SIG_T1X") * (shear < -1e-3 ? -1.0 : 1.0) < 0.0);
    CHECK(value(along_s, 1, "SIG_T2X") * (shear < 1e-3 ? -1.0 : 1.0) < 0.0);
    for (const ElementField* skin : {&along_t, &along_s}) {
      const auto part = [&](const char* x, const char* y) {
        return Eigen::Vector2d(value(*skin, 1, x), value(*skin, 1, y));
      };
      const Eigen::Vector2d first = part("SIG_T1X", "SIG_T1Y"), second = part("SIG_T2X", "SIG_T2Y");
      CHECK(std::abs(first.dot(second)) < 1e-12 * first.norm() * second.norm());
      CHECK(first.norm() == exactly(std::abs(value(*skin, 1, "SIG_T1"))));
      // Both together are the stress again.
      CHECK(first[0] * first[1] / value(*skin, 1, "SIG_T1") + second[0] * second[1] / value(*skin, 1, "SIG_T2") ==
            Approx(shear).margin(1e-12));
    }
  }
}

TEST_CASE("a uniform stress on an edge of a plane body", "[fields]") {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  mesh.add_cell(CellType::seg2, std::array{1, 2});  // outward normal +X
  ElementField stress{"SIEF_R", Support::element_node, {"SIXX", "SIYY", "SIZZ", "SIXY"}, {0, 4, 4}, {}};
  for (int i = 0; i < 4; ++i) stress.values.insert(stress.values.end(), {100, 200, 30, 50});
  const ElementField skin = surface_stresses(mesh, stress, std::array{1});
  CHECK(value(skin, 1, "SIG_N") == exactly(100));
  CHECK(value(skin, 1, "SIG_NY") == exactly(50));
  CHECK(value(skin, 1, "SIG_T1") == exactly(200));
  CHECK(value(skin, 1, "SIG_TX") == exactly(50));
  CHECK(value(skin, 1, "SIG_TN") == exactly(50));
  CHECK(value(skin, 1, "SIG_T2") == exactly(30));
  CHECK(value(skin, 1, "SIG_T2Z") == exactly(30));
}

TEST_CASE("a curved face is seen along its mean normal", "[fields]") {
  // A quadratic tetrahedron with the middle of one edge of a face pushed out, and that face. The vector area of a
  // surface is half the integral of x cross dx round it; an edge that is a parabola with its middle off the chord by s
  // adds 2/3 s x chord to the triangle of the corners.
  const auto places = reference_nodes(CellType::tetra10);
  Mesh mesh;
  for (const auto& at : places) mesh.nodes.push_back({at[0], at[1], at[2]});
  mesh.add_cell(CellType::tetra10, std::array{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  const BoundaryFacet& facet = boundary_facets(CellType::tetra10)[0];
  std::array<int, 6> face{};
  std::copy_n(facet.nodes.begin(), 6, face.begin());
  mesh.add_cell(CellType::tria6, face);
  const Eigen::Vector3d bump(0.2, -0.1, 0.15);
  for (int i = 0; i < 3; ++i) mesh.nodes[face[3]][i] += bump[i];
  const auto at = [&](int i) { return Eigen::Vector3d(mesh.nodes[face[i]].data()); };
  const Eigen::Vector3d area = 0.5 * (at(1) - at(0)).cross(at(2) - at(0)) + 2.0 / 3.0 * bump.cross(at(1) - at(0));
  const Eigen::Vector3d n = area.normalized();
  ElementField stress{
      "SIEF_R", Support::element_node, {"SIXX", "SIYY", "SIZZ", "SIXY", "SIXZ", "SIYZ"}, {0, 10, 10}, {}};
  for (int i = 0; i < 10; ++i) stress.values.insert(stress.values.end(), {3, -2, 5, 1, 4, -1});
  Eigen::Matrix3d tensor;
  tensor << 3, 1, 4, 1, -2, -1, 4, -1, 5;
  const ElementField skin = surface_stresses(mesh, stress, std::array{1});
  CHECK(value(skin, 1, "SIG_N") == exactly(n.dot(tensor * n)));
  CHECK(value(skin, 1, "SIG_NX") == exactly(n.dot(tensor * n) * n[0]));
}

}  // namespace surface_stresses_test
