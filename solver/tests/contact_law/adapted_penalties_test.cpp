#include "solver/contact_law/adapted_penalties.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

namespace comma::solver {
namespace {

const std::vector<char> all = {1};

/// Points that face the facets of a row in the plane, of these lengths.
struct Row {
  ContactDefinition definition;
  Mesh mesh;
  std::vector<ContactPoint> points;
  AdaptedPenalties penalties;

  explicit Row(const std::vector<double>& lengths, std::optional<double> allowed = std::nullopt) {
    mesh.dimension = 2;
    mesh.nodes.push_back({0.0, 0.0, 0.0});
    for (const double length : lengths) {
      mesh.nodes.push_back({mesh.nodes.back()[0] + length, 0.0, 0.0});
      const int last = mesh.node_count() - 1;
      ContactPoint& point = points.emplace_back();
      point.facet = mesh.add_cell(CellType::seg2, std::vector<int>{last - 1, last});
    }
    definition.zones.emplace_back().mixed.adapts_penalty = true;
    definition.zones.front().mixed.largest_depth = allowed;
    start(false);
  }
  void start(bool closed) {
    penalties.start_step(closed);
    penalties.face(definition, points, mesh);
  }
};

}  // namespace

TEST_CASE("Facets count by their diagonals, triangles by a median, segments by their length") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {4, 0, 0}, {4, 10, 0}, {0, 10, 0}, {5.5, 3.5, 0}};
  CHECK(facet_size(mesh, mesh.add_cell(CellType::quad4, std::vector<int>{0, 1, 2, 3})) ==
        Approx(2.0 * std::sqrt(116.0)));
  CHECK(facet_size(mesh, mesh.add_cell(CellType::tria3, std::vector<int>{0, 1, 2})) == Approx(std::hypot(2.0, 10.0)));
  CHECK(facet_size(mesh, mesh.add_cell(CellType::tria3, std::vector<int>{1, 2, 0})) == Approx(std::hypot(4.0, 5.0)));
  CHECK(facet_size(mesh, mesh.add_cell(CellType::seg2, std::vector<int>{0, 2})) == Approx(std::sqrt(116.0)));
}

TEST_CASE("A penalty grows as the published rule has it, and at least as many times as a point is too deep") {
  constexpr double far = std::numeric_limits<double>::infinity();
  CHECK(penalty_growth(1.5, far, 1.0) == 2.0);
  CHECK(penalty_growth(30.0, far, 1.0) == 30.0);
  CHECK(penalty_growth(1.5, 1.5, 1.0) == Approx(std::pow(std::sqrt(0.5) + 1.0, 2)));
  CHECK(penalty_growth(15.0, 15.0, 1.0) == 15.0);
  CHECK(penalty_growth(1.5, 1.2, 1.0) == penalty_growth(1.5, 1.5, 1.0));
}

TEST_CASE("A step begins with a penalty by the facets that are faced, and a depth that nothing gives is theirs too") {
  const Row row({0.8, 4.0, 2.0});
  CHECK(row.penalties.penalty(0) == Approx(5e5));
  CHECK(row.penalties.allowed_depth(0) == Approx(8e-3));
  CHECK(Row({0.8, 4.0}, 300.0).penalties.allowed_depth(0) == 300.0);
}

TEST_CASE("What would be stiffer than the bodies is a hundred times softer, and no softer than the least at first") {
  Row row({1.0}, 1e-3);
  CHECK_FALSE(row.penalties.adapt(all, std::vector<double>{1e-3}, 1e9, false));
  Row soft({1.0}, 1e-3);
  // 50 times too deep: 5e6 is more than 1e6, and 5e4 less than 1e5; 200 times 2e7, and 2e5.
  CHECK_FALSE(soft.penalties.adapt(all, std::vector<double>{0.05}, 1e6, false));
  Row softer({1.0}, 1e-3);
  CHECK(softer.penalties.adapt(all, std::vector<double>{0.2}, 1e6, false));
  CHECK(softer.penalties.penalty(0) == Approx(2e5));
  CHECK(softer.penalties.adapt(all, std::vector<double>{0.02}, 1e6, false));
  CHECK(softer.penalties.penalty(0) == Approx(4e4));
  softer.start(true);
  CHECK(softer.penalties.penalty(0) == 1e5);
}

TEST_CASE("Points of a pressure that stays come to lie at a hundred times the depth allowed") {
  Row row({1.0}, 1e-4);
  constexpr double pressure = 1e6;
  for (int k = 0; k < 3; ++k)
    row.penalties.adapt(all, std::vector<double>{pressure / row.penalties.penalty(0)}, 750.0, false);
  CHECK(pressure / row.penalties.penalty(0) == Approx(1e-2));
}

}  // namespace comma::solver
