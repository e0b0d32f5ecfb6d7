#include "solver/constraints/facing_nodes.hpp"

#include <numbers>

#include <catch2/catch.hpp>

#include "solver/constraints/directions.hpp"
#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace facing_nodes_test {

const Origin origin = std::make_shared<const std::string>("test");

/// Nodes 0 to 3 along X, nodes 4 to 7 opposite them in another order, a little off.
Mesh two_lines(double gap) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {2.1, gap, 0}, {0.1, gap, 0}, {3.1, gap, 0}, {1.1, gap, 0}};
  return mesh;
}

TEST_CASE("each node faces the nearest one of the other set") {
  const Mesh mesh = two_lines(5.0);
  const auto pairs = facing_nodes(mesh, std::vector{0, 1, 2, 3, 1}, std::vector{4, 5, 6, 7});
  REQUIRE(pairs.size() == 4);
  const int expected[] = {5, 7, 4, 6};
  for (int k = 0; k < 4; ++k) {
    CHECK(pairs[k].first == k);
    CHECK(pairs[k].second == expected[k]);
  }
}

TEST_CASE("a rotation and a translation bring one set onto the other") {
  Mesh mesh;
  for (int k = 0; k < 5; ++k) mesh.nodes.push_back({1.0 + k, 0.0, 0.0});
  for (int k = 4; k >= 0; --k) mesh.nodes.push_back({0.0, 1.0 + k, 7.0});
  Placement placement;
  placement.rotation = nautical_axes(0.5 * std::numbers::pi, 0.0, 0.0).transpose();
  placement.translation = {0.0, 0.0, 7.0};
  const auto pairs = facing_nodes(mesh, std::vector{0, 1, 2, 3, 4}, std::vector{5, 6, 7, 8, 9}, placement, 1e-9);
  for (int k = 0; k < 5; ++k) CHECK(pairs[k].second == 9 - k);
}

TEST_CASE("sets that do not face each other are refused, and the nodes named") {
  const Mesh mesh = two_lines(1.0);
  CHECK_THROWS_WITH(facing_nodes(mesh, std::vector{0, 1}, std::vector{4}), Catch::Contains("2 nodes"));
  CHECK_THROWS_WITH(facing_nodes(mesh, std::vector{0, 1}, std::vector{5, 6}),
                    Catch::Contains("N1 and N2") && Catch::Contains("N6"));
  CHECK_THROWS_WITH(facing_nodes(mesh, std::vector{0, 1}, std::vector{5, 7}, {}, 0.5), Catch::Contains("N1"));
}

TEST_CASE("relations of pairs: components with their factors, or normals") {
  const Mesh mesh = two_lines(1.0);
  const std::vector<NodePair> pairs = {{0, 5}, {1, 7}};
  const std::vector<FacingTerm> first = {{Component::dx, 1.0}, {Component::drz, 2.0}}, second = {{Component::dx, -1.0}};
  const auto relations = facing_relations(mesh, pairs, first, second, {}, {}, 0.25, {}, origin);
  REQUIRE(relations.size() == 2);
  CHECK(relations[1].value == 0.25);
  REQUIRE(relations[1].terms.size() == 3);
  CHECK(relations[1].terms[1].component == Component::drz);
  CHECK(relations[1].terms[2].node == 7);
  const std::vector<FacingTerm> normal = {{std::nullopt, 3.0}};
  const std::map<int, Eigen::Vector3d> normals = {{0, {0.6, 0.8, 0.0}}, {5, {0.0, -1.0, 0.0}}};
  const auto sliding =
      facing_relations(mesh, std::span(pairs).first(1), normal, normal, normals, normals, 0.0, {}, origin);
  REQUIRE(sliding[0].terms.size() == 3);
  CHECK(sliding[0].terms[1].coefficient == exactly(2.4));
  CHECK(sliding[0].terms[2].component == Component::dy);
  CHECK(sliding[0].terms[2].coefficient == -3.0);
  CHECK_THROWS_WITH(facing_relations(mesh, pairs, normal, normal, normals, normals, 0.0, {}, origin),
                    Catch::Contains("N2"));
}

}  // namespace facing_nodes_test
