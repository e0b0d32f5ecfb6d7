#include "solver/contact/patch_points.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using Eigen::Vector3d;

namespace {

/// An arc of two SEG3 about the origin, wholly inside another of two that reaches farther: a pin in a bush.
struct Arcs {
  std::shared_ptr<Mesh> mesh = std::make_shared<Mesh>();
  Model model;
  ContactDefinition definition;
  std::vector<Vector3d> places;

  Arcs(double slave_radius, double master_radius) {
    mesh->dimension = 2;
    // Counter-clockwise about a solid inside: outward is away from the origin; the bush goes the other way round.
    definition.zones.emplace_back();
    ContactZone& zone = definition.zones.front();
    zone.mixed.local_average = true;
    for (int k = 0; k < 2; ++k) zone.slave_cells.push_back(arc(slave_radius, 0.2 * k - 0.2, 0.2 * k));
    for (int k = 0; k < 2; ++k) zone.master_cells.push_back(arc(master_radius, 0.3 - 0.25 * k, 0.05 - 0.3 * k));
    for (const int cell : zone.slave_cells) mesh->slave_patches.push_back({cell});
    model.mesh = mesh;
    model.formulations.assign(static_cast<std::size_t>(mesh->cell_count()), Formulation::plane_strain);
    for (const Point& node : mesh->nodes) places.emplace_back(node[0], node[1], node[2]);
  }

  int node(double radius, double angle) {
    const Point at = {radius * std::cos(angle), radius * std::sin(angle), 0.0};
    for (int known = 0; known < mesh->node_count(); ++known)
      if (std::hypot(mesh->nodes[known][0] - at[0], mesh->nodes[known][1] - at[1]) < 1e-12) return known;
    mesh->nodes.push_back(at);
    return mesh->node_count() - 1;
  }

  int arc(double radius, double from, double to) {
    const std::vector<int> nodes = {node(radius, from), node(radius, to), node(radius, 0.5 * (from + to))};
    return mesh->add_cell(CellType::seg3, nodes);
  }

  std::vector<ContactPoint> points(const std::vector<Vector3d>& now) const {
    std::vector<ContactPoint> result;
    append_patch_points(definition, 0, model, now, 0.0, result);
    return result;
  }
};

}  // namespace

TEST_CASE("The mean gap of a patch is that of the surfaces, now and along its shares") {
  const Arcs arcs(10.0, 10.5);
  const auto points = arcs.points(arcs.places);
  REQUIRE(points.size() == 2);
  for (const ContactPoint& point : points) {
    CHECK(point.status == PairingStatus::paired);
    // Lengths of parabolas by Gauss's rule, in pieces and at once.
    CHECK(point.weight == Approx(point.area).epsilon(1e-8));
    // Parabolas over half an angle a leave the arc by up to R a^4 / 16, here 1.6e-4 of the bush's.
    CHECK(mean_gap(point, arcs.places) == Approx(0.5).margin(1.6e-4));
  }
  // The bush widens: its nodes move along their normals, and the gaps by as much; along its shares, which are those of
  // the force on it, by the bush's own length over the pin's.
  std::vector<Vector3d> wider = arcs.places;
  for (Vector3d& place : wider)
    if (place.norm() > 10.25) place *= 10.6 / 10.5;
  for (const ContactPoint& point : points)
    CHECK(mean_gap(point, wider) == Approx(mean_gap(point, arcs.places) + 0.105).epsilon(1e-3));
  for (const ContactPoint& point : arcs.points(wider)) CHECK(mean_gap(point, wider) == Approx(0.6).margin(1.6e-4));
}

TEST_CASE("The pressure of a patch acts on each node along the normal there") {
  Arcs arcs(10.0, 10.01);
  arcs.definition.smooth_normals = true;
  for (const ContactPoint& point : arcs.points(arcs.places)) {
    double pin = 0.0;
    double bush = 0.0;
    for (const GapShare& share : point.shares) {
      const Vector3d& place = arcs.places[static_cast<std::size_t>(share.node)];
      const Vector3d radial = place.normalized();
      // The normal at the end of a parabola over half an angle a leaves the radius by a^3 / 4, here 8e-4.
      CHECK(share.coefficient.cross(radial).norm() < 1e-3 * share.coefficient.norm());
      (place.norm() < 10.005 ? pin : bush) += share.coefficient.dot(radial);
    }
    // The pin is pressed inwards, the bush outwards, each over its own area.
    CHECK(pin == Approx(-1.0).epsilon(1e-6));
    CHECK(bush == Approx(1.001).epsilon(2e-5));
  }
}

TEST_CASE(
    "Without smoothing, the pressure of a patch has the resultant of a uniform pressure on the curve: that on its "
    "chord") {
  const Arcs arcs(10.0, 10.01);
  const auto points = arcs.points(arcs.places);
  for (std::size_t p = 0; p < points.size(); ++p) {
    Vector3d pin = Vector3d::Zero();
    for (const GapShare& share : points[p].shares)
      if (arcs.places[static_cast<std::size_t>(share.node)].norm() < 10.005)
        pin += points[p].weight * share.coefficient;
    const auto nodes = arcs.mesh->cell(arcs.definition.zones.front().slave_cells[p]);
    const Vector3d chord =
        arcs.places[static_cast<std::size_t>(nodes[1])] - arcs.places[static_cast<std::size_t>(nodes[0])];
    CHECK((pin + Vector3d(chord[1], -chord[0], 0.0)).norm() < 1e-9 * chord.norm());
  }
}

TEST_CASE("Surfaces face each other as the bodies are, and pressures act over the areas before") {
  Mesh mesh;
  for (const double z : {0.0, -0.1})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {0.0, 1.0}})
      mesh.nodes.push_back({x, y, z});
  mesh.nodes.push_back({1.0, 0.5, 0.0});
  ContactDefinition definition;
  definition.zones.emplace_back();
  ContactZone& zone = definition.zones.front();
  zone.mixed.local_average = true;
  // The slave's outward normal is down, the master's up.
  for (const std::vector<int>& nodes : {std::vector{8, 1, 0}, {8, 2, 1}, {8, 3, 2}, {8, 0, 3}})
    zone.slave_cells.push_back(mesh.add_cell(CellType::tria3, nodes));
  zone.master_cells.push_back(mesh.add_cell(CellType::quad4, std::vector{4, 5, 6, 7}));
  mesh.slave_patches.push_back(zone.slave_cells);
  Model model;
  model.formulations.assign(5, Formulation::solid);
  std::vector<Vector3d> moved;
  for (const Point& node : mesh.nodes) moved.emplace_back(node[0], node[1], node[2]);
  model.mesh = std::make_shared<Mesh>(mesh);
  // The master moves by 0.5, and becomes twice as wide the other way.
  for (std::size_t node = 4; node < 8; ++node) moved[node] = {moved[node][0] + 0.5, 2.0 * moved[node][1] - 0.5, -0.1};
  std::vector<ContactPoint> points;
  append_patch_points(definition, 0, model, moved, 0.0, points);
  REQUIRE(points.size() == 1);
  CHECK(points[0].area == exactly(2.0));
  CHECK(points[0].weight == exactly(1.5));
  double on_slave = 0.0;
  double on_master = 0.0;
  for (const GapShare& share : points[0].shares)
    (share.node >= 4 && share.node < 8 ? on_master : on_slave) += points[0].weight * share.coefficient[2];
  CHECK(on_slave == exactly(1.5));
  CHECK(on_master == exactly(-0.75));
  definition.zones.front().mixed.present_areas = true;  // the slave lies as it was
  append_patch_points(definition, 0, model, moved, 0.0, points);
  double on_present_master = 0.0;
  for (const GapShare& share : points[1].shares)
    if (share.node >= 4 && share.node < 8) on_present_master += points[1].weight * share.coefficient[2];
  CHECK(on_present_master == exactly(-1.5));
}

TEST_CASE("The mean gap of a patch is over areas as they are, and by the radius now where axisymmetric") {
  // A slave from the axis to 2, cut at 1; the master is above it by the radius, everything having become twice as wide.
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 1, 0}};
  ContactDefinition definition;
  definition.zones.emplace_back();
  ContactZone& zone = definition.zones.front();
  zone.mixed.local_average = true;
  // Outward is on the right of the way: up for the slave, down for the master.
  for (const std::vector<int>& nodes : {std::vector{1, 0}, {2, 1}})
    zone.slave_cells.push_back(mesh.add_cell(CellType::seg2, nodes));
  zone.master_cells.push_back(mesh.add_cell(CellType::seg2, std::vector{3, 4}));
  mesh.slave_patches.push_back(zone.slave_cells);
  Model model;
  model.formulations.assign(3, Formulation::axisymmetric);
  model.mesh = std::make_shared<Mesh>(mesh);
  std::vector<Vector3d> now = {{0, 0, 0}, {1.2, 0, 0}, {2, 0, 0}, {0, 0, 0}, {2, 2, 0}};
  std::vector<ContactPoint> points;
  append_patch_points(definition, 0, model, now, 0.0, points);
  REQUIRE(points.size() == 1);
  CHECK(points[0].weight == exactly(0.5));                // integral of r from 0 to 1
  CHECK(mean_gap(points[0], now) == exactly(4.0 / 3.0));  // of r r over that of r, from 0 to 2
  // Bodies that have gone through the axis face nothing.
  for (Vector3d& place : now) place[0] -= 3.0;
  append_patch_points(definition, 0, model, now, 0.0, points);
  CHECK(points[1].status == PairingStatus::outside);
}

TEST_CASE("A patch too far from the master faces nothing, and a slave face needs a patch") {
  Arcs arcs(10.0, 10.5);
  arcs.definition.zones.front().pairing_distance = 0.4;
  for (const ContactPoint& point : arcs.points(arcs.places)) {
    CHECK(point.status == PairingStatus::too_far);
    CHECK(point.weight == 0.0);
    CHECK(point.area > 0.0);
  }
  // Nearest nodes are not just opposite.
  arcs.definition.zones.front().pairing_distance = 1.5;
  for (const ContactPoint& point : arcs.points(arcs.places)) CHECK(point.status == PairingStatus::paired);
  arcs.mesh->slave_patches.pop_back();
  CHECK_THROWS_AS(patches_of(arcs.definition.zones.front(), *arcs.mesh), Error);
}
