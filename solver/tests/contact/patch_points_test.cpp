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

  /// The places once one of the arcs has turned about the origin.
  std::vector<Vector3d> turned(bool is_slave, double angle) const {
    std::vector<Vector3d> result = places;
    const int slave_nodes = 5;
    for (int node = 0; node < mesh->node_count(); ++node)
      if ((node < slave_nodes) == is_slave) result[static_cast<std::size_t>(node)] = Eigen::AngleAxisd(angle, Vector3d::UnitZ()) * result[static_cast<std::size_t>(node)];
    return result;
  }

  double slide(const std::vector<Vector3d>& now) const { return largest_slide(definition, *mesh, now, places); }

  std::vector<ContactPoint> points(const std::vector<Vector3d>& now) const {
    std::vector<ContactPoint> result;
    append_patch_points(definition, 0, model, now, places, 0.0, result);
    return result;
  }
};

double gap_of(const ContactPoint& point, const std::vector<Vector3d>& places) {
  double gap = -point.offset;
  for (const GapShare& share : point.shares) gap += share.coefficient.dot(places[static_cast<std::size_t>(share.node)]);
  return gap;
}

}  // namespace

TEST_CASE("The mean gap of a patch is that of the surfaces, now and along its shares") {
  const Arcs arcs(10.0, 10.5);
  const auto points = arcs.points(arcs.places);
  REQUIRE(points.size() == 2);
  for (const ContactPoint& point : points) {
    CHECK(point.status == PairingStatus::paired);
    // Lengths of parabolas by Gauss's rule, in pieces and at once.
    CHECK(point.weight == Approx(point.area).epsilon(1e-9));
    // Parabolas over half an angle a leave the arc by up to R a^4 / 16, here 1.6e-4 of the bush's.
    CHECK(gap_of(point, arcs.places) == Approx(0.5).margin(1.6e-4));
  }
  // The bush widens: its nodes move along their normals, and the gaps by as much.
  std::vector<Vector3d> wider = arcs.places;
  for (Vector3d& place : wider)
    if (place.norm() > 10.25) place *= 10.6 / 10.5;
  for (const ContactPoint& point : points) CHECK(gap_of(point, wider) == Approx(gap_of(point, arcs.places) + 0.1).epsilon(1e-3));
  for (const ContactPoint& point : arcs.points(wider)) CHECK(gap_of(point, wider) == Approx(0.6).margin(1.6e-4));
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
    // The pin is pressed inwards, the bush outwards, by the same.
    CHECK(pin == Approx(-1.0).epsilon(1e-6));
    CHECK(bush == Approx(1.0).epsilon(1e-6));
  }
}

TEST_CASE("Without smoothing, the pressure of a patch has the resultant of a uniform pressure on the curve: that on its chord") {
  const Arcs arcs(10.0, 10.01);
  const auto points = arcs.points(arcs.places);
  for (std::size_t p = 0; p < points.size(); ++p) {
    Vector3d pin = Vector3d::Zero();
    for (const GapShare& share : points[p].shares)
      if (arcs.places[static_cast<std::size_t>(share.node)].norm() < 10.005) pin += points[p].weight * share.coefficient;
    const auto nodes = arcs.mesh->cell(arcs.definition.zones.front().slave_cells[p]);
    const Vector3d chord = arcs.places[static_cast<std::size_t>(nodes[1])] - arcs.places[static_cast<std::size_t>(nodes[0])];
    CHECK((pin + Vector3d(chord[1], -chord[0], 0.0)).norm() < 1e-9 * chord.norm());
  }
}

TEST_CASE("In space what faces each other follows the bodies") {
  Mesh mesh;
  for (const double z : {0.0, -0.1})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {0.0, 1.0}}) mesh.nodes.push_back({x, y, z});
  mesh.nodes.push_back({1.0, 0.5, 0.0});
  ContactDefinition definition;
  definition.zones.emplace_back();
  ContactZone& zone = definition.zones.front();
  zone.mixed.local_average = true;
  // The slave's outward normal is down, the master's up.
  for (const std::vector<int>& nodes : {std::vector{8, 1, 0}, {8, 2, 1}, {8, 3, 2}, {8, 0, 3}}) zone.slave_cells.push_back(mesh.add_cell(CellType::tria3, nodes));
  zone.master_cells.push_back(mesh.add_cell(CellType::quad4, std::vector{4, 5, 6, 7}));
  mesh.slave_patches.push_back(zone.slave_cells);
  Model model;
  model.formulations.assign(5, Formulation::solid);
  std::vector<Vector3d> places;
  for (const Point& node : mesh.nodes) places.emplace_back(node[0], node[1], node[2]);
  model.mesh = std::make_shared<Mesh>(mesh);
  std::vector<Vector3d> moved = places;
  for (std::size_t node = 4; node < 8; ++node) moved[node][0] += 0.5;
  std::vector<ContactPoint> points;
  append_patch_points(definition, 0, model, moved, places, 0.0, points);
  REQUIRE(points.size() == 1);
  CHECK(points[0].area == exactly(2.0));
  CHECK(points[0].weight == exactly(1.5));
}

TEST_CASE("Surfaces that turn against each other slide, by a share of the smaller facet") {
  const Arcs arcs(10.0, 10.5);
  // The boxes of the slave arcs: 10 sin(0.2) high, 10 (1 - cos(0.2)) wide.
  const double size = 20.0 * std::sin(0.1);
  CHECK(arcs.slide(arcs.places) == 0.0);
  // A chord of 10 times the angle, but for its square; parabolas are arcs to 1e-4.
  CHECK(arcs.slide(arcs.turned(true, 0.03)) == Approx(0.3 / size).epsilon(2e-3));
  // The bush moves by 10.5 times the angle.
  CHECK(arcs.slide(arcs.turned(false, 0.03)) == Approx(0.315 / size).epsilon(2e-3));
  // Where nothing faces the other surface any more, what faced it then tells.
  CHECK(arcs.slide(arcs.turned(true, 1.0)) > 1.0);
}

TEST_CASE("Surfaces that come closer, or are far apart, do not slide, nor do those that follow the bodies anyway") {
  Arcs arcs(10.0, 10.5);
  std::vector<Vector3d> closer = arcs.places;
  for (Vector3d& place : closer)
    if (place.norm() > 10.25) place *= 10.1 / 10.5;
  CHECK(arcs.slide(closer) < 1e-3);
  const Arcs apart(10.0, 14.0);
  CHECK(apart.slide(apart.turned(true, 0.03)) == 0.0);
  CHECK(faces_as_at_start(arcs.definition.zones.front(), *arcs.mesh));
  arcs.definition.zones.front().mixed.local_average = false;
  CHECK_FALSE(faces_as_at_start(arcs.definition.zones.front(), *arcs.mesh));
  CHECK(arcs.slide(arcs.turned(true, 0.03)) == 0.0);
}

TEST_CASE("A patch that faces nothing carries nothing, and a slave face needs a patch") {
  Arcs arcs(10.0, 10.5);
  arcs.definition.zones.front().pairing_distance = 0.4;
  for (const ContactPoint& point : arcs.points(arcs.places)) {
    CHECK(point.status == PairingStatus::outside);
    CHECK(point.weight == 0.0);
    CHECK(point.area > 0.0);
  }
  arcs.mesh->slave_patches.pop_back();
  CHECK_THROWS_AS(patches_of(arcs.definition.zones.front(), *arcs.mesh), Error);
}
