#include "solver/contact/normals.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/error.hpp"

using namespace comma::solver;
using Eigen::Vector3d;

namespace {

std::vector<Vector3d> places(const Mesh& mesh) {
  std::vector<Vector3d> result;
  for (const Point& p : mesh.nodes) result.emplace_back(p[0], p[1], p[2]);
  return result;
}

/// A convex corner: an edge along x, then one going up.
Mesh corner() {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  mesh.add_cell(CellType::seg2, std::vector<int>{0, 1});
  mesh.add_cell(CellType::seg2, std::vector<int>{1, 2});
  return mesh;
}

}  // namespace

TEST_CASE("A node's normal is the mean of its facets'") {
  const Mesh mesh = corner();
  const auto normals = nodal_normals(mesh, std::vector<int>{0, 1}, places(mesh));
  CHECK((normals.at(0) - Vector3d(0, -1, 0)).norm() < 1e-15);
  CHECK((normals.at(1) - Vector3d(std::sqrt(0.5), -std::sqrt(0.5), 0)).norm() < 1e-15);
}

TEST_CASE("A given master normal replaces the facet's, at unit length") {
  const Mesh mesh = corner();
  ContactZone zone;
  CHECK((surface_normal(master_choice(zone), mesh, 1, {0, 0}, places(mesh)) - Vector3d(1, 0, 0)).norm() < 1e-15);
  zone.master_normal = NormalRule::fixed;
  zone.master_vector = {0, 3, 4};
  CHECK((surface_normal(master_choice(zone), mesh, 1, {0, 0}, places(mesh)) - Vector3d(0, 0.6, 0.8)).norm() < 1e-15);
  zone.master_vector = {0, 0, 0};
  CHECK_THROWS_AS(surface_normal(master_choice(zone), mesh, 1, {0, 0}, places(mesh)), Error);
}

TEST_CASE("The contact direction runs from master to slave on whichever side it is taken") {
  const Vector3d up(0, 1, 0);
  CHECK(contact_normal(NormalSide::master, up, -up) == up);
  CHECK(contact_normal(NormalSide::slave, up, -up) == up);
  CHECK(contact_normal(NormalSide::average, up, -up) == up);
  CHECK_THROWS_AS(contact_normal(NormalSide::average, up, up), Error);
}

TEST_CASE("A line in space needs a given normal") {
  Mesh mesh = corner();
  mesh.dimension = 3;
  CHECK_THROWS_AS(surface_normal(NormalChoice{}, mesh, 0, {0, 0}, places(mesh)), Error);
}

TEST_CASE("A normal across a given direction is square to it, on lines in space and on faces") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {2, 0, 0}, {2, 1, 1}, {0, 1, 1}};
  mesh.add_cell(CellType::seg2, std::vector<int>{0, 1});
  mesh.add_cell(CellType::quad4, std::vector<int>{0, 1, 2, 3});
  ContactZone zone;
  zone.master_normal = NormalRule::along_y;
  zone.master_vector = {0, 2, 0};
  CHECK((surface_normal(master_choice(zone), mesh, 0, {0, 0}, places(mesh)) - Vector3d(0, 0, 1)).norm() < 1e-15);
  // The face's own normal is (0, -1, 1) / sqrt(2).
  CHECK((surface_normal(master_choice(zone), mesh, 1, {0, 0}, places(mesh)) - Vector3d(0, 0, 1)).norm() < 1e-15);
  zone.master_vector = {1, 0, 0};
  CHECK_THROWS_AS(surface_normal(master_choice(zone), mesh, 0, {0, 0}, places(mesh)), Error);
  CHECK((surface_normal(master_choice(zone), mesh, 1, {0, 0}, places(mesh)) -
         Vector3d(0, -std::sqrt(0.5), std::sqrt(0.5)))
            .norm() < 1e-15);
}

TEST_CASE("Normals at nodes follow the rule that is given for the surface") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}};
  mesh.add_cell(CellType::seg2, std::vector<int>{0, 1});
  mesh.add_cell(CellType::seg2, std::vector<int>{1, 2});
  // Across z, a line along x has the normal -y and one along y has x: the mean of both at the corner.
  const auto across = nodal_normals(mesh, std::vector<int>{0, 1}, places(mesh), {NormalRule::along_y, {0, 0, 1}});
  CHECK((across.at(0) - Vector3d(0, -1, 0)).norm() < 1e-15);
  CHECK((across.at(1) - Vector3d(std::sqrt(0.5), -std::sqrt(0.5), 0)).norm() < 1e-15);
  const auto fixed = nodal_normals(mesh, std::vector<int>{0, 1}, places(mesh), {NormalRule::fixed, {0, 0, 2}});
  for (const int node : {0, 1, 2}) CHECK((fixed.at(node) - Vector3d(0, 0, 1)).norm() < 1e-15);
}
