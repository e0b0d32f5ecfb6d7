#include "solver/contact/pairing.hpp"

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using Eigen::Vector3d;

namespace {

/// Two master edges (0,0)-(2,0)-(4,0), outward normal up, and slave nodes above.
struct Table {
  Mesh mesh;
  ContactDefinition definition;

  explicit Table(const std::vector<Vector3d>& slaves) {
    mesh.dimension = 2;
    mesh.nodes = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}};
    ContactZone zone;
    zone.master_cells = {mesh.add_cell(CellType::seg2, std::vector<int>{1, 0}),
                         mesh.add_cell(CellType::seg2, std::vector<int>{2, 1})};
    for (const Vector3d& at : slaves) mesh.nodes.push_back({at[0], at[1], at[2]});
    for (int i = 3; i + 1 < mesh.node_count(); ++i)
      zone.slave_cells.push_back(mesh.add_cell(CellType::seg2, std::vector<int>{i, i + 1}));
    definition.zones.push_back(zone);
  }

  std::vector<ContactPair> pair(const FacedFacets& before = {}) const {
    std::vector<Vector3d> positions;
    for (const Point& p : mesh.nodes) positions.emplace_back(p[0], p[1], p[2]);
    return pair_surfaces(definition, mesh, positions, 0.0, before);
  }
  ContactZone& zone() { return definition.zones.front(); }
};

}  // namespace

TEST_CASE("Slave nodes take the facet under them") {
  const auto pairs = Table({{0.5, 1, 0}, {3, 0.2, 0}}).pair();
  REQUIRE(pairs.size() == 2);
  CHECK(pairs[0].facet == 0);
  CHECK(pairs[0].weights[1] == exactly(0.75));  // nodes 1, 0: three quarters of the way to node 0
  CHECK(pairs[1].facet == 1);
  CHECK((pairs[1].normal - Vector3d(0, 1, 0)).norm() == 0.0);
  CHECK((pairs[1].foot - Vector3d(3, 0, 0)).norm() < 1e-14);
}

TEST_CASE("A projection outside the surface is brought back within the tolerance, and refused beyond") {
  Table table({{4.4, 1, 0}, {4.6, 1, 0}});  // outside by 0.4 and 0.6 of a half edge
  CHECK(table.pair()[0].status == PairingStatus::paired);
  CHECK((table.pair()[0].foot - Vector3d(4, 0, 0)).norm() == 0.0);
  CHECK(table.pair()[1].status == PairingStatus::outside);
  table.zone().projection_tolerance = -1.0;
  CHECK(table.pair()[0].status == PairingStatus::outside);
}

TEST_CASE("Within a margin a slave node keeps the facet that it faced, and facing the surface at all") {
  Table table(
      {{2.02, 1, 0},
       {4.54, 1, 0}});  // beside the first facet by 0.02 of a half edge; beyond the last one and its tolerance by 0.04
  CHECK(table.pair()[0].facet == 1);
  CHECK(table.pair({{0, 1}, 0.03})[0].facet == 0);
  CHECK((table.pair({{0, 1}, 0.03})[0].foot - Vector3d(2, 0, 0)).norm() == 0.0);
  CHECK(table.pair({{0, 1}, 0.01})[0].facet == 1);
  CHECK(table.pair({{0, 1}, 0.03})[1].status == PairingStatus::outside);
  CHECK(table.pair({{0, 1}, 0.05})[1].status == PairingStatus::paired);
  CHECK(table.pair({{0, -1}, 0.05})[1].status == PairingStatus::outside);
  // Those that the user leaves out are not counted.
  table.zone().excluded_slave_nodes = {3};
  CHECK(table.pair({{1}, 0.05})[1].status == PairingStatus::paired);
}

TEST_CASE("The pairing distance is measured to the nearest master node") {
  Table table({{1, 0, 0}, {2.1, 0.3, 0}});
  table.zone().pairing_distance = 0.5;
  CHECK(table.pair()[0].status == PairingStatus::too_far);  // on the facet, but one unit from its ends
  CHECK(table.pair()[1].status == PairingStatus::paired);
}

TEST_CASE("Excluded slave nodes are not paired") {
  Table table({{1, 1, 0}, {3, 1, 0}});
  table.zone().excluded_slave_nodes = {4};
  CHECK(table.pair()[0].status == PairingStatus::paired);
  CHECK(table.pair()[1].status == PairingStatus::excluded);
}

TEST_CASE("Above a node that two facets share the choice does not depend on their order") {
  Table table({{2, 1, 0}, {9, 1, 0}});
  CHECK(table.pair()[0].facet == 0);
  std::swap(table.zone().master_cells[0], table.zone().master_cells[1]);
  CHECK(table.pair()[0].facet == 0);
}

TEST_CASE("Above a ridge the first facet of the mesh is taken, however far outside the point falls") {
  Table table({{2.01, 1, 0}, {1.99, 1, 0}, {9, 9, 0}});
  table.mesh.nodes[0][1] = -0.9;  // the first facet falls off more steeply, so that points come down farther outside it
  table.mesh.nodes[2][1] = -0.3;
  CHECK(table.pair()[0].facet == 0);
  CHECK(table.pair()[1].facet == 0);
}

TEST_CASE("Of two facets the nearer is taken, be it nearer by a millionth of a millionth") {
  Table table({{2, 1, 0}, {9, 9, 0}});
  table.mesh.nodes.push_back({2, 1e-12, 0});
  const int tip = table.mesh.node_count() - 1;
  table.zone().master_cells[1] = table.mesh.add_cell(CellType::seg2, std::vector<int>{2, tip});
  CHECK(table.pair()[0].facet == table.zone().master_cells[1]);
}

TEST_CASE("A slave node that belongs to a master facet is not paired with itself") {
  Table table({{1, 1, 0}, {3, 1, 0}});
  table.zone().slave_cells = {table.mesh.add_cell(CellType::seg2, std::vector<int>{0, 3})};
  for (const ContactPair& pair : table.pair())
    if (pair.slave == 0) CHECK(pair.facet != 0);
}

TEST_CASE("With a pairing direction a slave node takes the facet that lies in it, not the nearest") {
  Table table({{1.5, 1, 0}, {3.5, 1, 0}});
  CHECK(table.pair()[0].facet == 0);
  table.zone().pairing_direction = {1.0, -1.0, 0.0};
  const auto pairs = table.pair();
  CHECK(pairs[0].facet == 1);
  CHECK((pairs[0].foot - Vector3d(2.5, 0, 0)).norm() < 1e-13);
  CHECK((pairs[0].normal - Vector3d(0, 1, 0)).norm() == 0.0);  // gaps stay along the normal
  CHECK(pairs[1].status == PairingStatus::paired);             // beyond the end by half of a half edge
  CHECK((pairs[1].foot - Vector3d(4, 0, 0)).norm() == 0.0);
}

TEST_CASE("Along its own normal a slave node faces only what it looks at") {
  const auto status = [](const Vector3d& first, const Vector3d& second, NormalSide side) {
    Table table({first, second});
    table.zone().normal_side = side;
    return table.pair()[0].status;
  };
  for (const NormalSide side : {NormalSide::slave, NormalSide::average}) {
    CHECK(status({1, 1, 0}, {2, 1, 0}, side) == PairingStatus::paired);    // downwards
    CHECK(status({1, 2, 0}, {1, 1, 0}, side) == PairingStatus::outside);   // sideways
    CHECK(status({2, 1, 0}, {1, 1, 0}, side) == PairingStatus::outside);   // upwards: the master is behind it
    CHECK(status({1, -1, 0}, {2, -1, 0}, side) == PairingStatus::paired);  // overlapping
  }
  CHECK(status({2, 1, 0}, {1, 1, 0}, NormalSide::master) == PairingStatus::paired);
}

TEST_CASE("A wall that it looks at is faced across the corner, the far side of a body in between is not") {
  Table table({{0.2, 1.5, 0}, {0.2, 0.5, 0}});  // looks to the left, above the floor
  ContactZone& zone = table.zone();
  zone.normal_side = NormalSide::slave;
  Mesh& mesh = table.mesh;
  const auto wall = [&](double x, bool to_the_right) {
    mesh.nodes.push_back({x, 0, 0});
    mesh.nodes.push_back({x, 2, 0});
    const int low = mesh.node_count() - 2, high = low + 1;
    zone.master_cells.push_back(
        mesh.add_cell(CellType::seg2, to_the_right ? std::vector<int>{low, high} : std::vector<int>{high, low}));
    return zone.master_cells.back();
  };
  CHECK(table.pair()[0].status == PairingStatus::outside);
  const int left = wall(-1.0, true);
  CHECK(table.pair()[0].facet == left);
  CHECK(table.pair()[0].normal == Vector3d(1, 0, 0));
  zone.master_cells.pop_back();
  wall(0.4, false);  // another body, to the right of the slave
  const int far_side = wall(0.6, true);
  CHECK(table.pair()[0].status == PairingStatus::outside);
  zone.master_cells = {far_side};
  CHECK(table.pair()[0].facet == far_side);  // overlapping it
}

TEST_CASE("What elements of slave cells add is taken off the gap, whatever those of the master have") {
  Table table({{1, 1, 0}, {3, 1, 0}});
  table.zone().half_thickness[0] = 0.2;  // the facet from x = 2 to x = 0
  table.zone().half_thickness[table.zone().slave_cells[0]] = 0.06;
  for (const ContactPair& pair : table.pair()) CHECK(pair.thickness == exactly(0.06));
}

TEST_CASE("What is added to either side is read where the slave node is") {
  Table table({{0.5, 1, 0}, {1.5, 1, 0}});
  const auto place = [](const Point& at, double time) { return 0.1 * at[0] + 0.01 * at[1] + time; };
  for (const auto side : {&ContactZone::slave_thickness, &ContactZone::master_thickness}) {
    Table other = table;
    other.zone().*side = place;
    for (const ContactPair& pair : other.pair()) {
      const Point& at = other.mesh.nodes[static_cast<std::size_t>(pair.slave)];
      CHECK(pair.thickness == exactly(place(at, 0.0)));
    }
  }
}

TEST_CASE("Beside a curved facet the normal is that of the mean of its tangents at the foot and at its end") {
  // Gaps that Code_Aster 17.3 has for these surfaces (CONT_NOEU, JEU), outside and inside the facet.
  struct Known {
    double x, gap;
  };
  for (const auto& [x, gap] : {Known{1.7, 1.196694861849}, Known{1.5, 1.115117454314}, Known{0.9, 0.9189985224781}}) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.nodes = {{-1, 0, 0}, {1, 0, 0}, {0, -0.2, 0}, {x, -1, 0}, {x + 1, -1, 0}};
    ContactDefinition definition;
    definition.zones.emplace_back();
    definition.zones[0].master_cells = {mesh.add_cell(CellType::seg3, std::vector<int>{0, 1, 2})};
    definition.zones[0].slave_cells = {mesh.add_cell(CellType::seg2, std::vector<int>{4, 3})};
    std::vector<Vector3d> positions;
    for (const Point& p : mesh.nodes) positions.emplace_back(p[0], p[1], p[2]);
    const ContactPair pair = pair_surfaces(definition, mesh, positions)[0];
    REQUIRE(pair.slave == 3);
    CHECK(pair.normal.dot(positions[3] - pair.foot) == Approx(gap).epsilon(1e-11));
  }
}

TEST_CASE("A slave node faces a facet around the nearest master node, unless another is much nearer") {
  // A ridge of a long and a short facet, (-4, 0)-(0, 0)-(0.3, 0.6), normals up, and a slave node whose nearest node is
  // the top of the short one.
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{-4, 0, 0}, {0, 0, 0}, {0.3, 0.6, 0}, {-0.6, 0.75, 0}, {-3, 3, 0}};
  ContactDefinition definition;
  definition.zones.emplace_back();
  definition.zones[0].master_cells = {mesh.add_cell(CellType::seg2, std::vector<int>{1, 0}),
                                      mesh.add_cell(CellType::seg2, std::vector<int>{2, 1})};
  definition.zones[0].slave_cells = {mesh.add_cell(CellType::seg2, std::vector<int>{3, 4})};
  std::vector<Vector3d> positions;
  for (const Point& p : mesh.nodes) positions.emplace_back(p[0], p[1], p[2]);
  CHECK(pair_surfaces(definition, mesh, positions)[0].facet == 1);  // 0.87 away, the long one 0.75
  // Apart from the ridge: a short facet whose nodes are near, a long one whose ends are far.
  const auto faced = [&](double height) {
    std::vector<Vector3d> places = positions;
    places[1] = {4, 0, 0};
    Mesh apart = mesh;
    apart.nodes.push_back({-0.6, height, 0});
    apart.nodes.push_back({0.6, height, 0});
    places.emplace_back(-0.6, height, 0);
    places.emplace_back(0.6, height, 0);
    ContactDefinition zone = definition;
    zone.zones[0].master_cells = {apart.add_cell(CellType::seg2, std::vector<int>{1, 0}),
                                  apart.add_cell(CellType::seg2, std::vector<int>{6, 5})};
    places[3] = {0, 0.5, 0};
    return pair_surfaces(zone, apart, places)[0].facet == zone.zones[0].master_cells[1];
  };
  CHECK(faced(-0.3));
  CHECK_FALSE(faced(-0.7));
}
