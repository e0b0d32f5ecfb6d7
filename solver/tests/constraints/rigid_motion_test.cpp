#include "solver/constraints/rigid_motion.hpp"

#include <catch2/catch.hpp>

#include "scene.hpp"

using namespace comma::solver;
using namespace comma::solver::test;
using Strings = std::vector<std::string>;

namespace rigid_motion_test {

constexpr auto dx = Component::dx;
constexpr auto dy = Component::dy;
constexpr auto dz = Component::dz;

/// Nodes joined by bars of a stiffness, and conditions on them.
struct Truss {
  Truss(const std::vector<Point>& points, const std::vector<std::pair<int, int>>& bars,
        const std::vector<LinearRelation>& relations, double bar_stiffness = 2e9 / 3.0,
        Formulation formulation = Formulation::spring_2d)
      : model(nodes_with_springs(points, formulation)),
        dofs(model),
        elimination(*model.mesh, dofs, applied(relations)) {
    const int dimension = model.mesh->dimension;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(dofs.size(), dofs.size());
    for (const auto& [a, b] : bars) {
      const Eigen::Vector3d axis =
          (Eigen::Map<const Eigen::Vector3d>(points[b].data()) - Eigen::Map<const Eigen::Vector3d>(points[a].data()))
              .normalized();
      const Eigen::VectorXd direction = axis.head(dimension);
      const Eigen::MatrixXd block = bar_stiffness * direction * direction.transpose();
      dense.block(a * dimension, a * dimension, dimension, dimension) += block;
      dense.block(b * dimension, b * dimension, dimension, dimension) += block;
      dense.block(a * dimension, b * dimension, dimension, dimension) -= block;
      dense.block(b * dimension, a * dimension, dimension, dimension) -= block;
    }
    const SymmetricMatrix lower = Eigen::MatrixXd(dense.triangularView<Eigen::Lower>()).sparseView(0.0, -1.0);
    stiffness = elimination.reduce(lower);
  }

  FactorReport report() const {
    auto solver = make_linear_solver(LinearMethod::eigen_ldlt, {});
    solver->analyse(stiffness);
    return solver->factorise(stiffness);
  }

  std::vector<FreePart> free_parts() const {
    return find_free_parts(*model.mesh, dofs, elimination, stiffness, report().null_rows);
  }

  Model model;
  DofMap dofs;
  Elimination elimination;
  SymmetricMatrix stiffness;
};

const std::vector<Point> square = {{0, 0, 0}, {50, 0, 0}, {50, 50, 0}, {0, 50, 0}};
const std::vector<std::pair<int, int>> braced = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {1, 3}};

const std::vector<Point> corner = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}};
const std::vector<std::pair<int, int>> tetrahedron = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

TEST_CASE("a plane body that nothing holds has three rigid motions") {
  const auto parts = Truss(square, braced, {}).free_parts();
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].rigid);
  CHECK(parts[0].nodes == std::vector<int>{0, 1, 2, 3});
  CHECK(parts[0].motions == Strings{"translation along X", "translation along Y", "rotation about Z"});
}

TEST_CASE("a body that slides names the direction and the remedy") {
  const Truss truss(square, braced, {relation({{2, dy}}, -1.0), relation({{3, dy}}, -1.0)});
  const FactorReport report = truss.report();
  REQUIRE(report.verdict == FactorVerdict::singular);
  const Error error = singular_matrix_error(*truss.model.mesh, truss.dofs, truss.elimination, truss.stiffness, report);
  CHECK(error.code() == "singular-matrix");
  CHECK(error.what() ==
        std::string("the stiffness is singular: nothing holds N1, N2, N3, N4 (4 nodes): translation along X"));
  CHECK(error.hint() == "impose DX on one of its nodes, or add a spring");
}

TEST_CASE("a body that something far weaker than itself holds is told from a free one") {
  Truss truss(square, braced, {relation({{2, dy}}, -1.0), relation({{3, dy}}, -1.0)});
  CHECK_FALSE(truss.free_parts().front().held_weakly);
  truss.stiffness.coeffRef(0, 0) *= 1.0 + 1e-10;  // a spring along X at the first node
  const auto parts = truss.free_parts();
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].held_weakly);
  CHECK(parts[0].motions == Strings{"translation along X"});
  CHECK_THAT(parts[0].remedy, Catch::EndsWith("let pivots lose more than 8 digits"));
}

TEST_CASE("a body on a hinge turns about it") {
  const auto parts = Truss(square, braced, {relation({{1, dx}}, 0.0), relation({{1, dy}}, 0.0)}).free_parts();
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].motions == Strings{"rotation about Z through (50, 0)"});
  CHECK(parts[0].nodes == std::vector<int>{0, 2, 3});
  CHECK(parts[0].remedy == "impose a displacement on nodes away from the axis of rotation, or add a spring");
}

TEST_CASE("a body between inclined guides slides along them") {
  std::vector<LinearRelation> guides;
  for (int node = 0; node < 4; ++node) guides.push_back(relation({{node, dx, 0.8}, {node, dy, -0.6}}, 0.0));
  const auto parts = Truss(square, braced, guides).free_parts();
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].motions == Strings{"translation along (0.6, 0.8)"});
  CHECK(parts[0].nodes.size() == 4);
}

TEST_CASE("only the free one of two bodies is named, however stiff the other") {
  std::vector<Point> points = square;
  for (const Point& point : square) points.push_back({point[0], point[1] + 100.0, 0.0});
  std::vector<std::pair<int, int>> bars = braced;
  for (const auto& [a, b] : braced) bars.emplace_back(a + 4, b + 4);
  Truss truss(points, bars, {relation({{0, dx}}, 0.0), relation({{0, dy}}, 0.0), relation({{1, dy}}, 0.0)});
  const auto parts = truss.free_parts();
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].nodes == std::vector<int>{4, 5, 6, 7});
  CHECK(parts[0].motions.size() == 3);
}

TEST_CASE("two bodies hung on the same fixed node swing each for itself") {
  const std::vector<Point> points = {{0, 0, 0}, {-1, -2, 0}, {0, -2, 0}, {1, -2, 0}, {2, -2, 0}};
  const auto parts = Truss(points, {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {0, 4}, {3, 4}},
                           {relation({{0, dx}}, 0.0), relation({{0, dy}}, 0.0)})
                         .free_parts();
  REQUIRE(parts.size() == 2);
  for (const FreePart& part : parts) CHECK(part.motions == Strings{"rotation about Z through (0, 0)"});
}

TEST_CASE("a parallelogram of bars sways, and only its moving side is named") {
  const Truss truss(
      square, {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
      {relation({{0, dx}}, 0.0), relation({{0, dy}}, 0.0), relation({{1, dx}}, 0.0), relation({{1, dy}}, 0.0)});
  const auto parts = truss.free_parts();
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].nodes == std::vector<int>{2, 3});
  CHECK(parts[0].motions == Strings{"translation along X"});
}

TEST_CASE("nodes that move in ratios are a mechanism, and those that move most are named") {
  const std::vector<Point> row = {{0, 0, 0}, {1, 0, 0}, {5, 0, 0}};
  std::vector<LinearRelation> relations = {relation({{1, dx}, {0, dx, -3.0}}, 0.0),
                                           relation({{2, dx}, {1, dx, -2.0}}, 0.0)};
  for (int node = 0; node < 3; ++node) relations.push_back(relation({{node, dy}}, 0.0));
  const auto parts = Truss(row, {}, relations).free_parts();
  REQUIRE(parts.size() == 1);
  CHECK_FALSE(parts[0].rigid);
  CHECK(parts[0].nodes == std::vector<int>{0, 1, 2});
  CHECK(parts[0].motions == Strings{"a motion without resistance that is largest in DX at N3, DX at N2, DX at N1"});
  CHECK(parts[0].remedy == "hold DX at N3, or add a spring there");
}

TEST_CASE("a node without stiffness moves in every direction") {
  std::vector<Point> points = square;
  points.push_back({7, 7, 0});
  const auto parts =
      Truss(points, braced, {relation({{0, dx}}, 0.0), relation({{0, dy}}, 0.0), relation({{1, dy}}, 0.0)})
          .free_parts();
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].nodes == std::vector<int>{4});
  CHECK(parts[0].motions == Strings{"translation along X", "translation along Y"});
}

TEST_CASE("a body tied to a free one by relations moves with it") {
  std::vector<Point> points = square;
  points.push_back({100, 0, 0});
  const auto parts = Truss(points, braced,
                           {relation({{0, dy}}, 0.0), relation({{1, dy}}, 0.0), relation({{4, dy}}, 0.0),
                            relation({{4, dx}, {1, dx, -1.0}}, 0.0)})
                         .free_parts();
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].motions == Strings{"translation along X"});
  CHECK(parts[0].nodes == std::vector<int>{0, 1, 2, 3, 4});
}

TEST_CASE("a solid that nothing holds has six rigid motions") {
  const auto parts = Truss(corner, tetrahedron, {}, 1.0 / 3.0, Formulation::spring_3d).free_parts();
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].motions == Strings{"translation along X", "translation along Y", "translation along Z",
                                    "rotation about X", "rotation about Y", "rotation about Z"});
}

TEST_CASE("a solid on two fixed nodes turns about the line through them") {
  std::vector<LinearRelation> relations;
  for (const int node : {0, 2}) {
    for (const auto component : {dx, dy, dz}) relations.push_back(relation({{node, component}}, 0.0));
  }
  const auto parts = Truss(corner, tetrahedron, relations, 1.0, Formulation::spring_3d).free_parts();
  REQUIRE(parts.size() == 1);
  CHECK_THAT(parts[0].motions.at(0), Catch::StartsWith("rotation about Y through (0, ") && Catch::EndsWith(", 0)"));
}

TEST_CASE("a solid on one fixed node turns about three axes through it") {
  std::vector<LinearRelation> relations;
  for (const auto component : {dx, dy, dz}) relations.push_back(relation({{1, component}}, 0.0));
  const auto parts = Truss(corner, tetrahedron, relations, 1.0, Formulation::spring_3d).free_parts();
  REQUIRE(parts.size() == 1);
  REQUIRE(parts[0].motions.size() == 3);
  CHECK_THAT(parts[0].motions[0], Catch::StartsWith("rotation about X through"));
  CHECK_THAT(parts[0].motions[1], Catch::StartsWith("rotation about Y through (3, "));
  CHECK_THAT(parts[0].motions[2], Catch::StartsWith("rotation about Z through (3, 0"));
}

TEST_CASE("a scene that is held has no free part") {
  const Truss truss(square, braced, {relation({{0, dx}}, 0.0), relation({{0, dy}}, 0.0), relation({{1, dy}}, 0.0)});
  CHECK(truss.report().verdict == FactorVerdict::ok);
  CHECK(truss.free_parts().empty());
}

}  // namespace rigid_motion_test
