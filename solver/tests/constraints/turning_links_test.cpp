#include "solver/constraints/turning_links.hpp"

#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/error.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::test;

namespace turning_links_test {

const Origin origin = std::make_shared<const std::string>("test");

/// Displacements that turn all nodes by a rotation vector about the origin and shift them.
Eigen::VectorXd moved(const Model& model, const DofMap& dofs, const Eigen::Vector3d& turn,
                      const Eigen::Vector3d& shift) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  Eigen::VectorXd u(dofs.size());
  for (int dof = 0; dof < dofs.size(); ++dof) {
    const Eigen::Vector3d x(model.mesh->nodes[dofs.node_of(dof)].data());
    u[dof] = (rotation * x - x + shift)[static_cast<int>(dofs.component_of(dof))];
  }
  return u;
}

double largest_residual(const DofMap& dofs, const std::vector<LinearRelation>& relations, const Eigen::VectorXd& u) {
  double largest = 0.0;
  for (const LinearRelation& relation : relations) {
    double sum = -relation.value;
    for (const auto& term : relation.terms) sum += term.coefficient * u[dofs.dof(term.node, term.component)];
    largest = std::max(largest, std::abs(sum));
  }
  return largest;
}

const std::vector<Point> corners = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0.3, 0.4, 1.5}};

TEST_CASE("relations of a rigid body that has turned hold there, and to first order beside it") {
  const Model model = nodes_with_springs(corners, Formulation::spring_3d);
  const DofMap dofs(model);
  const std::vector<RigidLink> links = {{{0, 1, 2, 3, 4}, 1e-6, origin}};
  const TurningLinks turning(*model.mesh, dofs, links);
  const Eigen::Vector3d turn(0.4, -1.1, 0.8), shift(0.2, 3.0, -1.0);
  const Eigen::VectorXd u = moved(model, dofs, turn, shift);
  const auto relations = turning.at(u);
  CHECK(relations.size() == 15 - 6);
  CHECK(turning.violation(u) < 1e-14);
  CHECK(largest_residual(dofs, relations, u) < 1e-13);
  // A further turn is missed by its square.
  const auto error = [&](double angle) {
    const Eigen::Matrix3d first = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    const Eigen::Matrix3d second = Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 2) / 3.0).toRotationMatrix();
    const Eigen::AngleAxisd both(Eigen::Matrix3d(second * first));
    return largest_residual(dofs, relations, moved(model, dofs, both.angle() * both.axis(), shift));
  };
  CHECK(error(1e-3) / error(1e-4) == Approx(100.0).epsilon(0.02));
}

TEST_CASE("a body that has been strained is led back to the rigid motion that is nearest") {
  const Model model = nodes_with_springs({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}});
  const DofMap dofs(model);
  const std::vector<RigidLink> links = {{{0, 1, 2, 3}, 1e-6, origin}};
  const TurningLinks turning(*model.mesh, dofs, links);
  Eigen::VectorXd u = moved(model, dofs, {0.0, 0.0, 2.5}, Eigen::Vector3d::Zero());
  const Eigen::VectorXd rigid = u;
  for (int node = 0; node < 4; ++node)
    for (const Component c : {Component::dx, Component::dy}) {
      const int dof = dofs.dof(node, c);
      u[dof] += 0.1 * (model.mesh->nodes[node][static_cast<int>(c)] + u[dof]);  // a tenth larger all round
    }
  CHECK(turning.violation(u) == exactly(0.1));
  CHECK(largest_residual(dofs, turning.at(u), rigid) < 1e-13);
}

TEST_CASE("nodes with rotations of their own cannot turn far") {
  const Model model = nodes_with_springs(corners, Formulation::spring_rotation_3d);
  const DofMap dofs(model);
  const std::vector<RigidLink> links = {{{0, 1}, 1e-6, origin}};
  CHECK_THROWS_AS(TurningLinks(*model.mesh, dofs, links), Error);
}

}  // namespace turning_links_test
