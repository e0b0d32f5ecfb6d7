#include "solver/constraints/weighted_average.hpp"

#include <random>

#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/constraints/elimination.hpp"
#include "solver/constraints/rigid_body_rows.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::test;

namespace weighted_average_test {

const Origin origin = std::make_shared<const std::string>("test");
constexpr ComponentMask translations = 0b000111, all = 0b111111;
const std::vector<Point> points = {{0.3, 0.1, 0.2}, {1, 0, 0}, {0, 1.5, 0}, {-1, 0, 2}, {0, -1, -1}, {2, 1, 1}};

/// The follower's motion by dense weighted least squares over the leaders' components.
Eigen::VectorXd least_squares(const Model& model, const DofMap& dofs, std::span<const AverageNode> leaders,
                              const Eigen::VectorXd& u) {
  const Eigen::Vector3d centre(model.mesh->nodes[0].data());
  double distance = 0.0;
  for (const auto& leader : leaders) {
    distance +=
        (Eigen::Vector3d(model.mesh->nodes[leader.node].data()) - centre).norm() / static_cast<double>(leaders.size());
  }
  std::vector<Eigen::Matrix<double, 1, 6>> rows;
  std::vector<double> right;
  for (const auto& leader : leaders) {
    for (int c = 0; c < 6; ++c) {
      if ((leader.components & (1 << c)) == 0) continue;
      const auto component = static_cast<Component>(c);
      const double root = std::sqrt(leader.weight) * (c < 3 ? 1.0 : distance);
      rows.push_back(root * rigid_body_row(component, Eigen::Vector3d(model.mesh->nodes[leader.node].data()) - centre));
      right.push_back(root * u[dofs.dof(leader.node, component)]);
    }
  }
  Eigen::MatrixXd a(rows.size(), 6);
  for (std::size_t i = 0; i < rows.size(); ++i) a.row(static_cast<Eigen::Index>(i)) = rows[i];
  return a.colPivHouseholderQr().solve(Eigen::Map<Eigen::VectorXd>(right.data(), a.rows()));
}

double follow(const LinearRelation& relation, const DofMap& dofs, const Eigen::VectorXd& u) {
  double value = 0.0;
  for (std::size_t k = 1; k < relation.terms.size(); ++k) {
    value -= relation.terms[k].coefficient * u[dofs.dof(relation.terms[k].node, relation.terms[k].component)];
  }
  return value;
}

TEST_CASE("the follower moves as weighted least squares fits the leaders (RBE3)") {
  const Model model = nodes_with_springs(points, Formulation::spring_rotation_3d);
  const DofMap dofs(model);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::VectorXd u(dofs.size());
  for (double& value : u) value = uniform(generator);
  for (const ComponentMask components : {translations, all, ComponentMask(0b010011 | 0b000100)}) {
    std::vector<AverageNode> leaders;
    for (int node = 1; node < 6; ++node) leaders.push_back({node, components, 0.5 + node});
    const auto relations = weighted_average(*model.mesh, dofs, 0, all, leaders, origin);
    const Eigen::VectorXd expected = least_squares(model, dofs, leaders, u);
    REQUIRE(relations.size() == 6);
    for (int c = 0; c < 6; ++c) {
      CHECK(relations[c].terms[0].component == static_cast<Component>(c));
      CHECK(follow(relations[c], dofs, u) == exactly(expected[c]));
    }
  }
}

TEST_CASE("forces on the follower reach the leaders with their resultant and moment, by way of the elimination") {
  const Model model = nodes_with_springs(points, Formulation::spring_rotation_3d);
  const DofMap dofs(model);
  std::vector<AverageNode> leaders;
  for (int node = 1; node < 6; ++node) leaders.push_back({node, translations, 1.0});
  const auto relations = weighted_average(*model.mesh, dofs, 0, all, leaders, origin);
  // The relations as they stand express the follower; turn them into a distribution of forces.
  Eigen::Matrix<double, 6, 1> load;
  load << 1, -2, 3, 0.5, -0.7, 0.9;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  for (int c = 0; c < 6; ++c) {
    for (std::size_t k = 1; k < relations[c].terms.size(); ++k) {
      const auto& term = relations[c].terms[k];
      const Eigen::Vector3d force =
          -term.coefficient * load[c] * Eigen::Vector3d::Unit(static_cast<int>(term.component));
      sum += force;
      moment += (Eigen::Vector3d(points[term.node].data()) - Eigen::Vector3d(points[0].data())).cross(force);
    }
  }
  CHECK((sum - load.head<3>()).norm() < 1e-13);
  CHECK((moment - load.tail<3>()).norm() < 1e-13);
  CHECK(Elimination(*model.mesh, dofs, applied(relations)).reduced_size() == dofs.size() - 6);
}

TEST_CASE("in the plane a follower without rotation takes the mean displacement, levers included") {
  // Four corners of a square of side 100, followed at (60, 50) along X alone: the corners above and below count alike,
  // since the mean rotation moves the follower, level with the centre, along Y only.
  const Model model = nodes_with_springs({{60, 50, 0}, {0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}});
  const DofMap dofs(model);
  std::vector<AverageNode> leaders;
  for (int node = 1; node < 5; ++node) leaders.push_back({node, translations, 1.0});
  const auto relations = weighted_average(*model.mesh, dofs, 0, mask_of(Component::dx), leaders, origin);
  REQUIRE(relations.size() == 1);
  REQUIRE(relations[0].terms.size() == 5);
  for (std::size_t k = 1; k < 5; ++k) CHECK(relations[0].terms[k].coefficient == exactly(-0.25));
}

TEST_CASE("what the leaders do not determine is an error that names it") {
  const Model model = nodes_with_springs({{0, 1, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, Formulation::spring_rotation_3d);
  const DofMap dofs(model);
  std::vector<AverageNode> leaders;
  for (int node = 1; node < 4; ++node) leaders.push_back({node, translations, 1.0});
  CHECK(weighted_average(*model.mesh, dofs, 0, mask_of(Component::drz), leaders, origin).size() == 1);
  CHECK_THROWS_WITH(weighted_average(*model.mesh, dofs, 0, mask_of(Component::drx), leaders, origin),
                    Catch::Contains("DRX") && Catch::Contains("N1"));
  leaders[0].weight = 0.0;
  CHECK_THROWS_WITH(weighted_average(*model.mesh, dofs, 0, all, leaders, origin), Catch::Contains("weight"));
}

}  // namespace weighted_average_test
