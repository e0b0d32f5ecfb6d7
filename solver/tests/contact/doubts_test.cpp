#include "solver/contact/doubts.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

/// A row of edges of unit length in all for each side, the slave one above, whose outward side is below it.
struct Sides {
  Mesh mesh;
  ContactDefinition definition;

  Sides(int slaves, int masters) {
    mesh.dimension = 2;
    ContactZone zone;
    zone.slave_cells = row(slaves, 1.0);
    zone.master_cells = row(masters, 0.0);
    definition.zones.push_back(zone);
  }

 private:
  std::vector<int> row(int count, double height) {
    std::vector<int> cells;
    const int first = mesh.node_count();
    for (int i = 0; i <= count; ++i) mesh.nodes.push_back({static_cast<double>(i) / count, height, 0.0});
    for (int i = 0; i < count; ++i)
      cells.push_back(mesh.add_cell(CellType::seg2, std::vector<int>{first + i, first + i + 1}));
    return cells;
  }
};

}  // namespace

TEST_CASE("Surfaces that have moved on since they were paired are told of by what their gaps are off") {
  // A slave node that slides over two edges, the second of which rises by a tenth of its length.
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.1, 0.0}, {0.5, 0.0, 0.0}, {0.5, 1.0, 0.0}};
  ContactZone zone;
  zone.master_cells = {mesh.add_cell(CellType::seg2, std::vector<int>{1, 0}),
                       mesh.add_cell(CellType::seg2, std::vector<int>{2, 1})};
  zone.slave_cells = {mesh.add_cell(CellType::seg2, std::vector<int>{3, 4})};
  ContactDefinition definition;
  definition.zones.push_back(zone);
  const auto places = [&](double slide) {
    std::vector<Eigen::Vector3d> result;
    for (const auto& node : mesh.nodes) result.emplace_back(node[0], node[1], node[2]);
    result[3][0] += slide;
    return result;
  };
  const auto told = [&](double slide, double pushed_back) {
    const auto before = pair_surfaces(definition, mesh, places(0.0)),
               now = pair_surfaces(definition, mesh, places(slide));
    ContactDoubts doubts;
    note_stale_geometry(definition, mesh, places(slide), {before, now, std::span(&pushed_back, 1)}, doubts);
    return doubts.all();
  };
  CHECK(told(0.0, 0.0).empty());
  CHECK(told(0.4, 0.0).empty());  // on the same edge
  const auto risen = told(1.0, 0.02);
  REQUIRE(risen.size() == 1);
  CHECK(risen.front().kind == DoubtKind::stale_geometry);
  CHECK(risen.front().node == 3);
  CHECK(risen.front().length == exactly(0.05 / std::sqrt(1.01)));  // half way up the slope
  CHECK(risen.front().share == 1.0);
  CHECK(told(1.0, 6.0).empty());  // less than a hundredth of what contact pushes back
}

TEST_CASE("Mean gaps that are not those which were solved for are told of") {
  Sides sides(1, 1);
  ContactZone& zone = sides.definition.zones.front();
  std::vector<Eigen::Vector3d> places;
  for (const auto& node : sides.mesh.nodes) places.emplace_back(node[0], node[1], node[2]);
  ContactPoint solved;
  solved.status = PairingStatus::paired;
  solved.node = sides.mesh.cell(zone.slave_cells.front())[0];
  solved.facet = zone.master_cells.front();
  solved.shares = {{solved.node, Eigen::Vector3d::UnitY()},
                   {sides.mesh.cell(solved.facet)[0], -Eigen::Vector3d::UnitY()}};
  solved.offset = 1.0;  // the gap of 1 is closed
  ContactPoint now = solved;
  now.offset = 1.03;
  const auto told = [&](double pushed_back) {
    ContactDoubts doubts;
    note_stale_averages(sides.definition, sides.mesh, places, std::span(&solved, 1), std::span(&now, 1),
                        std::span(&pushed_back, 1), doubts);
    return doubts.all();
  };
  CHECK(told(1.0).empty());  // no average
  zone.mixed.local_average = true;
  REQUIRE(told(1.0).size() == 1);
  CHECK(told(1.0).front().kind == DoubtKind::stale_geometry);
  CHECK(told(1.0).front().node == solved.node);
  CHECK(told(1.0).front().length == exactly(0.03));
  CHECK(told(4.0).empty());
  now.offset = 0.5;
  CHECK(told(1.0).size() == 1);  // closed where it should be open
  solved.offset = 0.0;
  CHECK(told(1.0).empty());  // open before and now
  now.offset = 1.5;
  solved.status = PairingStatus::outside;
  CHECK(told(1.0).size() == 1);
  now.offset = 0.5;
  CHECK(told(1.0).empty());
}

TEST_CASE("The penalty that is proposed leaves no more than its goal, and is no more than ten times too large") {
  const double stiffness = 3.0e7;  // of the bodies, in series with the penalty
  for (double penalty = 1.0e-6 * stiffness; penalty < 100.0 * stiffness; penalty *= 7.0) {
    const auto share = [&](double of) { return stiffness / (stiffness + of); };
    const double wanted = wanted_penalty(penalty, share(penalty));
    CHECK(share(wanted) <= penalty_goal * (1.0 + 1e-6));
    CHECK(share(wanted / 10.0) > penalty_goal);
  }
}

TEST_CASE("Of the doubts about a zone the deepest stays, one of each kind") {
  ContactDoubts doubts;
  doubts.note({.kind = DoubtKind::soft_penalty, .zone = 0, .length = 1.0});
  doubts.note({.kind = DoubtKind::soft_penalty, .zone = 0, .length = 3.0});
  doubts.note({.kind = DoubtKind::soft_penalty, .zone = 0, .length = 2.0});
  doubts.note({.kind = DoubtKind::soft_penalty, .zone = 1, .length = 0.5});
  doubts.note({.kind = DoubtKind::soft_friction, .zone = 0, .length = 0.1});
  REQUIRE(doubts.all().size() == 3);
  CHECK(doubts.all().front().length == 3.0);
}

TEST_CASE("Master nodes that have gone through the slave side are told of by their mean depth") {
  Sides sides(2, 16);
  const auto told = [&](double deep, double pushed_back, double other = 0.0) {
    std::vector<Eigen::Vector3d> places;
    for (const auto& node : sides.mesh.nodes) places.emplace_back(node[0], node[1], node[2]);
    // Every other master node, of the ones in front of the slave.
    for (const int cell : sides.definition.zones.front().master_cells)
      for (const int node : sides.mesh.cell(cell))
        places[static_cast<std::size_t>(node)][1] = 1.0 + (node % 2 == 0 ? deep : 0.0);
    ContactDoubts found;
    PassedMaster passed(sides.definition, sides.mesh);
    std::vector<double> by_zone(sides.definition.zones.size(), other);
    by_zone.front() = pushed_back;
    passed.look(places, by_zone, 0.0);
    passed.conclude(found);
    return found.all();
  };
  const auto half = told(0.2, 1.0);
  REQUIRE(half.size() == 1);
  CHECK(half.front().kind == DoubtKind::passed_master);
  CHECK(half.front().length == Approx(0.1).margin(0.01));  // 8 or 9 of 17 nodes
  CHECK(half.front().share == exactly(half.front().length));
  CHECK(told(0.2, 1.6).front().share == exactly(half.front().share / 1.6));
  CHECK(told(0.05, 1.0).empty());
  CHECK(told(-0.2, 1.0).empty());
  // Nothing pushed back, and nodes that lay in front are behind.
  REQUIRE(told(0.2, 0.0).size() == 1);
  CHECK(std::isinf(told(0.2, 0.0).front().share));
  CHECK(told(-0.2, 0.0).empty());
  // Both sides go far together, and rounding is left of what lies between them.
  CHECK(told(1e-8, 0.0).empty());
  CHECK(told(1e-3, 0.0).size() == 1);
  // What another zone pushes back is no measure of this one.
  sides.definition.zones.push_back(sides.definition.zones.front());
  sides.definition.zones.back().resolved = false;
  REQUIRE(told(0.2, 1.0, 100.0).size() == 1);
  CHECK(told(0.2, 1.0, 100.0).front().share == exactly(half.front().share));
  sides.definition.zones.pop_back();
  sides.definition.zones.front().mixed.local_average = true;
  CHECK(told(0.2, 1.0).empty());
  sides.definition.zones.front().pairing_distance = 0.1;
  CHECK(told(0.2, 1.0).size() == 1);
}

TEST_CASE("A penalty is doubted where points lie deep beside what holds them, not for what rounding leaves") {
  const auto told = [](double length, double reach) {
    ContactDoubts found;
    note_soft_penalty({.kind = DoubtKind::soft_penalty, .length = length, .penalty = 1e8}, reach, 2.0, found);
    return found.all().size();
  };
  CHECK(told(1e-5, 2e-5) == 1);
  CHECK(told(1e-5, 2e-3) == 0);
  CHECK(told(1.7e-59, 4e-58) == 0);
}

TEST_CASE("Middle nodes of a quadratic master that go through a linear slave are told of, though its corners cannot") {
  Mesh mesh;
  mesh.dimension = 3;
  mesh.nodes = {{-1, -1, 0}, {2, -1, 0},  {2, 2, 0},   {-1, 2, 0},    // the slave side
                {0, 0, 0},   {1, 0, 0},   {1, 1, 0},   {0, 1, 0},     // and the master's corners,
                {0.5, 0, 0}, {1, 0.5, 0}, {0.5, 1, 0}, {0, 0.5, 0}};  // and middle nodes
  ContactZone zone;
  zone.slave_cells = {mesh.add_cell(CellType::quad4, std::vector<int>{0, 3, 2, 1})};
  zone.master_cells = {mesh.add_cell(CellType::quad8, std::vector<int>{4, 5, 6, 7, 8, 9, 10, 11})};
  ContactDefinition definition;
  definition.zones.push_back(zone);
  std::vector<Eigen::Vector3d> places;
  for (const auto& at : mesh.nodes) places.emplace_back(at.data());
  for (int middle = 8; middle < 12; ++middle) places[static_cast<std::size_t>(middle)][2] = 0.1;
  PassedMaster passed(definition, mesh);
  ContactDoubts found;
  passed.look(places, std::vector<double>{1.0}, 0.0);
  passed.conclude(found);
  REQUIRE(found.all().size() == 1);
  // Middle nodes stand for a third of the face each, corners for a twelfth.
  CHECK(found.all().front().share == exactly(0.1 * (4.0 / 3.0) / (4.0 / 3.0 + 4.0 / 12.0)));
}
