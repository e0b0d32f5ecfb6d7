#include "solver/constraints/section_link.hpp"

#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/constraints/elimination.hpp"
#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::test;

namespace section_link_test {

const Origin origin = std::make_shared<const std::string>("test");

/// A rectangle of 2 x 3 in the plane normal to (1, 0, 1), of four quadrangles with sides of different length, and a
/// beam's node at its centre.
struct Section {
  Section() {
    model.mesh = std::make_shared<Mesh>();
    Mesh& mesh = *model.mesh;
    const double s[] = {-1.0, 0.3, 1.0}, t[] = {-1.5, -0.5, 1.5};
    const Eigen::Vector3d a(0, 1, 0), b = Eigen::Vector3d(1, 0, -1).normalized();
    for (const double i : s) {
      for (const double j : t) {
        const Eigen::Vector3d x = centre + i * a + j * b;
        mesh.nodes.push_back({x[0], x[1], x[2]});
      }
    }
    mesh.nodes.push_back({centre[0], centre[1], centre[2]});
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j)
        mesh.add_cell(CellType::quad4, std::vector{3 * i + j, 3 * i + 3 + j, 3 * i + 4 + j, 3 * i + 1 + j});
    }
    mesh.add_cell(CellType::poi1, std::vector{9});
    model.formulations.assign(4, Formulation::solid);
    model.formulations.push_back(Formulation::spring_rotation_3d);
  }

  Eigen::Vector3d centre{1.0, 2.0, 3.0};
  Model model;
};

template <class U, class R>
double residual(const Mesh& mesh, const LinearRelation& relation, U&& displacement, R&& rotation) {
  double sum = 0.0;
  for (const auto& term : relation.terms) {
    const int c = static_cast<int>(term.component);
    sum +=
        term.coefficient * (c < 3 ? displacement(Eigen::Vector3d(mesh.nodes[term.node].data()))[c] : rotation[c - 3]);
  }
  return sum;
}

TEST_CASE("a section that moves rigidly takes the beam's node along") {
  const Section section;
  const SectionLink link = section_link(*section.model.mesh, std::vector{0, 1, 2, 3}, 9, origin);
  REQUIRE(link.relations.size() == 6);
  CHECK((link.centroid - section.centre).norm() < 1e-14);
  CHECK(link.offset < 1e-14);
  CHECK(link.size == exactly(std::sqrt((4.0 + 9.0) / 12.0)));
  const Eigen::Vector3d translation(0.3, -0.2, 0.9), rotation(0.5, 0.7, -0.4);
  const auto u = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return translation + rotation.cross(x); };
  for (const auto& relation : link.relations)
    CHECK(std::abs(residual(*section.model.mesh, relation, u, rotation)) < 1e-14);
  const DofMap dofs(section.model);
  CHECK(Elimination(*section.model.mesh, dofs, applied(link.relations)).reduced_size() == dofs.size() - 6);
}

TEST_CASE("the section may warp and change its shape: a mean of zero moves the beam not at all") {
  const Section section;
  const Mesh& mesh = *section.model.mesh;
  const SectionLink link = section_link(mesh, std::vector{0, 1, 2, 3}, 9, origin);
  const Eigen::Vector3d a(0, 1, 0), b = Eigen::Vector3d(1, 0, -1).normalized(),
                                    n = Eigen::Vector3d(1, 0, 1).normalized();
  // Stretching in the plane, and out of it the bilinear s t, whose integral and moments vanish on a rectangle.
  const auto stretch = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    const Eigen::Vector3d r = x - section.centre;
    return 0.3 * a * a.dot(r) - 0.1 * b * b.dot(r) + 0.2 * n * a.dot(r) * b.dot(r);
  };
  for (const auto& relation : link.relations)
    CHECK(std::abs(residual(mesh, relation, stretch, Eigen::Vector3d::Zero())) < 1e-14);
}

TEST_CASE("an edge in the plane joins a beam's node by three relations") {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{1, 0, 0}, {1, 2, 0}, {1, 1, 0}, {1, 3, 0}, {1, 2.5, 0}, {1, 1.6, 0}};
  mesh.add_cell(CellType::seg3, std::vector{0, 1, 2});
  mesh.add_cell(CellType::seg3, std::vector{1, 3, 4});
  const SectionLink link = section_link(mesh, std::vector{0, 1}, 5, origin);
  REQUIRE(link.relations.size() == 3);
  CHECK(link.offset == exactly(0.1));
  const Eigen::Vector3d rotation(0, 0, 0.4);
  const auto turned = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return rotation.cross(x - link.centroid); };
  CHECK(std::abs(residual(mesh, link.relations[2], turned, rotation)) < 1e-14);
  mesh.add_cell(CellType::poi1, std::vector{0});
  CHECK_THROWS_WITH(section_link(mesh, std::vector{2}, 5, origin), Catch::Contains("M3"));
}

TEST_CASE("an L of plates that moves rigidly takes the beam's node along") {
  // The beam lies along Z; nodes of plates turn with the section.
  Mesh mesh;
  mesh.dimension = 3;
  mesh.nodes = {{0, 0, 1}, {2, 0, 1}, {0, 1, 1}, {0.5, 0.5, 1}};
  mesh.add_cell(CellType::seg2, std::vector{0, 1});
  mesh.add_cell(CellType::seg2, std::vector{0, 2});
  const std::vector<PlateEdge> edges = {{0, 0.1}, {1, 0.3}};
  const SectionLink link = plate_section_link(mesh, edges, Eigen::Vector3d(0, 0, 2), 3, origin);
  REQUIRE(link.relations.size() == 6);
  const Eigen::Vector3d centroid(0.2 / 0.5, 0.15 / 0.5, 1.0);  // of areas 0.2 and 0.3
  CHECK((link.centroid - centroid).norm() < 1e-14);
  const Eigen::Vector3d translation(0.3, -0.2, 0.9), rotation(0.5, 0.7, -0.4);
  for (const auto& relation : link.relations) {
    double sum = 0.0;
    for (const auto& term : relation.terms) {
      const int c = static_cast<int>(term.component);
      // The beam's node has the motion of the centroid, wherever it lies.
      const Eigen::Vector3d at = term.node == 3 ? centroid : Eigen::Vector3d(mesh.nodes[term.node].data());
      sum += term.coefficient * (c < 3 ? (translation + rotation.cross(at))[c] : rotation[c - 3]);
    }
    CHECK(std::abs(sum) < 1e-14);
  }
}

TEST_CASE("an edge of a plate along the beam is no section of it") {
  Mesh mesh;
  mesh.dimension = 3;
  mesh.nodes = {{0, 0, 0}, {0, 0, 1}};
  mesh.add_cell(CellType::seg2, std::vector{0, 1});
  CHECK_THROWS_WITH(plate_section_link(mesh, std::vector<PlateEdge>{{0, 0.1}}, Eigen::Vector3d::UnitZ(), 0, origin),
                    Catch::Contains("lies along the axis of the beam"));
}

}  // namespace section_link_test
