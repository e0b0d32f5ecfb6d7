#include "solver/constraints/embedding.hpp"

#include <catch2/catch.hpp>

#include "solver/error.hpp"
#include "solver/mesh/axes.hpp"
#include "solver/mesh/place.hpp"
#include "solver/tests/elements/sample_meshes.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::testing;

namespace embedding_test {

const Origin origin = std::make_shared<const std::string>("test");

double quadratic(const Point& x) {
  return 1.0 + x[0] - 2.0 * x[1] + 0.5 * x[2] + 0.3 * x[0] * x[1] - 0.2 * x[1] * x[1];
}
double linear(const Point& x) { return 1.0 + x[0] - 2.0 * x[1] + 0.5 * x[2]; }

TEST_CASE(
    "a node in a cell takes the cell's linear field, on curved cells too; quadratic cells give quadratic fields when "
    "straight") {
  std::vector<CellType> types(std::begin(plane_types), std::end(plane_types));
  types.insert(types.end(), std::begin(solid_types), std::end(solid_types));
  for (const CellType type : types) {
    CAPTURE(name_of(type));
    for (const double bend : {0.0, 0.04}) {
      auto mesh = single_cell(type, bend);
      // A point of the reference cell off its symmetries, by the map that single_cell uses.
      const bool solid = dimension(type) == 3;
      const bool simplex = corner_count(type) == 3 || (solid && corner_count(type) == 4);
      const double r = simplex ? 0.2 : 0.15, s = simplex ? 0.3 : 0.25, t = solid ? 0.1 : 0.0;
      const Eigen::VectorXd n = shape_functions(type, {r, s, t});
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      for (int a = 0; a < n.size(); ++a) x += n[a] * Eigen::Vector3d(mesh->nodes[a].data());
      mesh->nodes.push_back({x[0], x[1], x[2]});
      const int node = mesh->node_count() - 1;
      const auto embeddings = embed(*mesh, std::vector{0, node}, std::vector{0});
      REQUIRE(embeddings.size() == 1);  // node 0 is the cell's own
      CHECK(embeddings[0].distance < 1e-12);
      double value = 0.0, square = 0.0;
      for (int a = 0; a < n.size(); ++a) {
        value += embeddings[0].weights[a] * linear(mesh->nodes[a]);
        square += embeddings[0].weights[a] * quadratic(mesh->nodes[a]);
      }
      CHECK(value == exactly(linear(mesh->nodes[node])));
      const bool complete = bend == 0.0 && node_count(type) > corner_count(type) && type != CellType::pyram13;
      if (complete) CHECK(square == exactly(quadratic(mesh->nodes[node])));
    }
  }
}

TEST_CASE("a node beside the cells is tied to the nearest point of the nearest one, within the distance allowed") {
  Mesh mesh;
  for (const auto& at : reference_nodes(CellType::hexa8)) mesh.nodes.push_back({at[0], at[1], at[2]});
  for (const auto& at : reference_nodes(CellType::hexa8)) mesh.nodes.push_back({at[0] + 10.0, at[1], at[2]});
  mesh.nodes.push_back({1.5, 0.2, -0.6});
  mesh.nodes.push_back({8.0, 5.0, 0.0});
  std::vector<int> first(8), second(8);
  for (int a = 0; a < 8; ++a) {
    first[a] = a;
    second[a] = a + 8;
  }
  mesh.add_cell(CellType::hexa8, first);
  mesh.add_cell(CellType::hexa8, second);
  const auto embeddings = embed(mesh, std::vector{16, 17}, std::vector{0, 1});
  REQUIRE(embeddings.size() == 2);
  CHECK(embeddings[0].cell == 0);
  CHECK(embeddings[0].distance == exactly(0.5));
  CHECK(embeddings[1].cell == 1);
  CHECK(embeddings[1].distance == exactly(std::sqrt(1.0 + 16.0)));
  CHECK_THROWS_WITH(embed(mesh, std::vector{16}, std::vector{0, 1}, 0.4), Catch::Contains("N17"));
  mesh.dimension = 3;
  Model model{std::make_shared<Mesh>(mesh), {Formulation::solid, Formulation::solid}};
  model.mesh->add_cell(CellType::poi1, std::vector{16});
  model.formulations.push_back(Formulation::spring_3d);
  const auto relations = embedding_relations(mesh, DofMap(model), embeddings, origin);
  REQUIRE(relations.size() == 3);  // the second node has no degrees of freedom
  CHECK(relations[2].terms[0].component == Component::dz);
  CHECK(relations[2].terms.size() == 5);  // the four corners of the face
  double sum = 0.0;
  for (const auto& term : relations[0].terms) sum += term.coefficient;
  CHECK(sum == Approx(0.0).margin(1e-15));
}

TEST_CASE("up to a hundredth beside a cell a place has its own value, and the first of equally near cells has it") {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.add_cell(CellType::quad4, std::array{1, 4, 5, 2});
  mesh.add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  const auto height = [&](double x, double y) {
    const Embedding host = embed_places(mesh, std::vector{Eigen::Vector3d(x, y, 0)}, std::array{0, 1}, 1.0).front();
    double sum = 0.0;
    for (std::size_t a = 0; a < host.weights.size(); ++a)
      sum += host.weights[a] * mesh.nodes[mesh.cell(host.cell)[a]][1];
    return sum;
  };
  CHECK(height(0.3, -0.009) == exactly(-0.009));
  CHECK(height(0.3, -0.011) == 0.0);
  // A place on the edge of both, and one that rounding has moved into the second.
  for (const double x : {1.0, 1.0 - 2e-16, 1.0 + 2e-16})
    CHECK(embed_places(mesh, std::vector{Eigen::Vector3d(x, 0.5, 0)}, std::array{0, 1}, 1.0).front().cell == 0);
}

TEST_CASE("a node beside a shell moves and turns with it as a rigid body does") {
  Model model;
  model.mesh = std::make_shared<Mesh>();
  Mesh& mesh = *std::const_pointer_cast<Mesh>(model.mesh);
  mesh.dimension = 3;
  mesh.nodes = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0.5, 1.2, 0.3}};
  mesh.add_cell(CellType::quad4, std::vector<int>{0, 1, 2, 3});
  mesh.add_cell(CellType::poi1, std::vector<int>{4});
  model.formulations = {Formulation::thin_plate, Formulation::spring_rotation_3d};
  const DofMap dofs(model);
  const std::vector<int> node = {4}, host = {0};
  const auto relations = shell_embedding_relations(mesh, dofs, embed(mesh, node, host), origin);
  CHECK(relations.size() == 6);
  const Eigen::Vector3d shift(0.1, -0.2, 0.3), turn(0.4, 0.5, -0.6);
  for (const LinearRelation& relation : relations) {
    double sum = 0.0;
    for (const auto& term : relation.terms) {
      const int c = static_cast<int>(term.component);
      const Eigen::Vector3d x(mesh.nodes[static_cast<std::size_t>(term.node)].data());
      sum += term.coefficient * (c < 3 ? (shift + turn.cross(x))[c] : turn[c - 3]);
    }
    CHECK(std::abs(sum) < 1e-14);
  }
}

// What a relation leaves of a displacement field, per node.
template <class FieldOf>
double left_of(const Mesh& mesh, const LinearRelation& relation, FieldOf&& field) {
  double sum = 0.0;
  for (const auto& term : relation.terms)
    sum += term.coefficient * field(place(mesh, term.node))[static_cast<int>(term.component)];
  return sum;
}

TEST_CASE("displacements turn with the movement that brings a node to a cell") {
  Mesh mesh;
  for (const auto& at : reference_nodes(CellType::hexa8)) mesh.nodes.push_back({at[0], at[1], at[2]});
  mesh.add_cell(CellType::hexa8, std::array{0, 1, 2, 3, 4, 5, 6, 7});
  Placement placement;
  placement.rotation = nautical_axes(0.6, 0.3, -0.4).transpose();
  placement.centre = {2.0, 1.0, -1.0};
  placement.translation = {0.5, 0.0, 0.2};
  // A node that is brought inside the cell, and one of the cell's own, which is brought beside it.
  const Eigen::Vector3d target(0.3, -0.2, 0.5);
  const Eigen::Vector3d from =
      placement.centre + placement.rotation.transpose() * (target - placement.translation - placement.centre);
  mesh.nodes.push_back({from[0], from[1], from[2]});
  const auto embeddings = embed_moved(mesh, std::vector{8, 0}, std::vector{0}, placement);
  REQUIRE(embeddings.size() == 2);
  CHECK(embeddings[0].distance == 0.0);
  CHECK(embeddings[1].distance > 0.1);
  // At the node a displacement of its own, in the cell the same linear field as seen from the place it comes from.
  const auto turned_field = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
    const Eigen::Vector3d before =
        placement.centre + placement.rotation.transpose() * (at - placement.translation - placement.centre);
    return placement.rotation * Eigen::Vector3d(1.0 + before[0], 2.0 * before[1] - before[2], 0.5 * before[0]);
  };
  const auto field = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
    return at == from ? Eigen::Vector3d(placement.rotation.transpose() * turned_field(target)) : turned_field(at);
  };
  mesh.add_cell(CellType::poi1, std::array{8});
  const DofMap all(Model{std::make_shared<Mesh>(mesh), {Formulation::solid, Formulation::spring_3d}});
  const std::span<const Embedding> first(embeddings.data(), 1);
  const auto relations = embedding_relations(mesh, all, first, origin, placement.rotation);
  REQUIRE(relations.size() == 3);
  for (const auto& relation : relations) CHECK(std::abs(left_of(mesh, relation, field)) < 1e-13);
  const std::map<int, Eigen::Vector3d> normals = {{8, Eigen::Vector3d(0.6, 0.0, 0.8)}};
  const auto along = normal_embedding_relations(mesh, all, first, normals, origin, placement.rotation);
  REQUIRE(along.size() == 1);
  CHECK(along[0].terms.front().node == 8);
  CHECK(std::abs(left_of(mesh, along[0], field)) < 1e-13);
  CHECK_THROWS_WITH(normal_embedding_relations(mesh, all, embeddings, normals, origin), Catch::Contains("no normal"));
  Mesh plane = mesh;
  plane.dimension = 2;
  const DofMap flat(Model{std::make_shared<Mesh>(plane), {Formulation::none, Formulation::spring_2d}});
  CHECK_THROWS_WITH(normal_embedding_relations(mesh, flat, first, normals, origin), Catch::Contains("along DZ"));
}

}  // namespace embedding_test
