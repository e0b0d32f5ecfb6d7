#include "solver/constraints/rigid_link.hpp"

#include <catch2/catch.hpp>

#include "scene.hpp"
#include "solver/constraints/elimination.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using namespace comma::solver::test;

namespace rigid_link_test {

const Origin origin = std::make_shared<const std::string>("test");
constexpr double coincidence = 1e-6;

/// Displacements of a rigid motion over the degrees of freedom of a model.
Eigen::VectorXd rigid(const Model& model, const DofMap& dofs, const Eigen::Vector3d& translation,
                      const Eigen::Vector3d& rotation) {
  Eigen::VectorXd u(dofs.size());
  for (int dof = 0; dof < dofs.size(); ++dof) {
    const Eigen::Vector3d x(model.mesh->nodes[dofs.node_of(dof)].data());
    const int c = static_cast<int>(dofs.component_of(dof));
    u[dof] = c < 3 ? (translation + rotation.cross(x))[c] : rotation[c - 3];
  }
  return u;
}

double residual(const DofMap& dofs, const LinearRelation& relation, const Eigen::VectorXd& u) {
  double sum = -relation.value;
  for (const auto& term : relation.terms) sum += term.coefficient * u[dofs.dof(term.node, term.component)];
  return sum;
}

/// Links all nodes and returns how many motions are left; checks that all rigid motions are.
int motions_left(const Model& model) {
  const DofMap dofs(model);
  std::vector<int> nodes(model.mesh->nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = static_cast<int>(i);
  const auto relations = rigid_link(*model.mesh, dofs, nodes, coincidence, origin);
  const bool plane = model.mesh->dimension == 2;
  for (int k = 0; k < 6; ++k) {
    if (plane && k != 0 && k != 1 && k != 5) continue;
    Eigen::Matrix<double, 6, 1> motion = Eigen::Matrix<double, 6, 1>::Unit(k);
    const Eigen::VectorXd u = rigid(model, dofs, motion.head<3>(), motion.tail<3>());
    for (const LinearRelation& relation : relations) CHECK(std::abs(residual(dofs, relation, u)) < 1e-12);
  }
  const Elimination elimination(*model.mesh, dofs, applied(relations));
  CHECK(static_cast<int>(relations.size()) ==
        elimination.full_size() - elimination.reduced_size());  // none is redundant
  return elimination.reduced_size();
}

const std::vector<Point> scattered = {{0, 0, 0}, {1, 0.2, -0.3}, {0.4, 2, 1}, {-1, 0.5, 3}, {2, 2, -1}};
const std::vector<Point> aligned = {{1, 1, 1}, {2, 3, 0}, {4, 7, -2}, {1.5, 2, 0.5}};
const std::vector<Point> coincident = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
const std::vector<Point> coplanar = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 2, 0}};

TEST_CASE("a rigid link leaves six motions in space, five to aligned nodes, three to coincident ones") {
  CHECK(motions_left(nodes_with_springs(scattered, Formulation::spring_3d)) == 6);
  CHECK(motions_left(nodes_with_springs(coplanar, Formulation::spring_3d)) == 6);
  CHECK(motions_left(nodes_with_springs(aligned, Formulation::spring_3d)) == 5);
  CHECK(motions_left(nodes_with_springs({{0, 0, 0}, {0, 0, 5}}, Formulation::spring_3d)) == 5);
  CHECK(motions_left(nodes_with_springs(coincident, Formulation::spring_3d)) == 3);
  CHECK(motions_left(nodes_with_springs({{1, 2, 3}}, Formulation::spring_3d)) == 3);
}

TEST_CASE("nodes with rotations turn with the body, wherever they lie") {
  for (const auto& points : {scattered, coplanar, aligned, coincident}) {
    CHECK(motions_left(nodes_with_springs(points, Formulation::spring_rotation_3d)) == 6);
  }
  Model mixed = nodes_with_springs(scattered, Formulation::spring_3d);
  mixed.formulations[2] = Formulation::spring_rotation_3d;
  CHECK(motions_left(mixed) == 6);
}

TEST_CASE("a rigid link leaves three motions in the plane, two to coincident nodes without rotation") {
  const std::vector<Point> points = {{0, 0, 0}, {2, 1, 0}, {-1, 3, 0}, {4, 4, 0}};
  CHECK(motions_left(nodes_with_springs(points)) == 3);
  CHECK(motions_left(nodes_with_springs({{0, 0, 0}, {1, 1, 0}})) == 3);
  CHECK(motions_left(nodes_with_springs({{1, 1, 0}, {1, 1, 0}})) == 2);
  Model turning = nodes_with_springs(points, Formulation::spring_rotation_2d);
  turning.mesh->dimension = 2;
  turning.formulations[0] = Formulation::spring_2d;
  CHECK(motions_left(turning) == 3);
}

TEST_CASE(
    "nodes closer to a line than the coincidence count as aligned: a free rotation about it would be a mechanism") {
  std::vector<Point> nearly = aligned;
  nearly[1][0] += 1e-5;
  const auto left = [&](double within) {
    const Model model = nodes_with_springs(nearly, Formulation::spring_3d);
    const DofMap dofs(model);
    const auto relations = rigid_link(*model.mesh, dofs, std::vector{0, 1, 2, 3}, within, origin);
    return dofs.size() - static_cast<int>(relations.size());
  };
  CHECK(left(1e-3) == 5);
  CHECK(left(1e-7) == 6);
}

TEST_CASE("nodes given twice count once, and nodes without element are named") {
  const Model model = nodes_in_a_row(3);
  const DofMap dofs(model);
  CHECK(rigid_link(*model.mesh, dofs, std::vector{0, 1, 0, 1}, coincidence, origin).size() == 1);
  CHECK(rigid_link(*model.mesh, dofs, std::vector{0, 0}, coincidence, origin).empty());
  Model bare = model;
  bare.formulations[1] = Formulation::none;
  CHECK_THROWS_WITH(rigid_link(*bare.mesh, DofMap(bare), std::vector{0, 1}, coincidence, origin),
                    Catch::Contains("N2"));
}

TEST_CASE("a rigid body on springs: eliminated, it answers a force as statics says") {
  // Springs of stiffness 1 in all directions at four corners of a square of side 2: a force F along X at height h turns
  // the body by F h / (sum of k r^2), and moves its centre by F / 4.
  const Model model = nodes_with_springs({{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 3, 0}});
  const DofMap dofs(model);
  const auto relations = rigid_link(*model.mesh, dofs, std::vector{0, 1, 2, 3, 4}, coincidence, origin);
  const Elimination elimination(*model.mesh, dofs, applied(relations));
  Eigen::VectorXd stiffness = Eigen::VectorXd::Ones(10);
  stiffness.tail<2>().setZero();
  const Eigen::MatrixXd t = elimination.transformation();
  Eigen::VectorXd force = Eigen::VectorXd::Zero(10);
  force[8] = 4.0;
  const Eigen::VectorXd u = t * (t.transpose() * stiffness.asDiagonal() * t).ldlt().solve(t.transpose() * force);
  const double turn = -4.0 * 3.0 / 8.0;
  CHECK(u[8] == exactly(1.0 - 3.0 * turn));
  CHECK(u[9] == Approx(0.0).margin(1e-12));
  CHECK(u[0] == exactly(1.0 - turn));
  CHECK(u[1] == exactly(turn));
}

TEST_CASE("coincidence is a thousandth of the shortest edge") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {3, 0, 0}, {3, 0.5, 0}, {0, 7, 0}};
  mesh.add_cell(CellType::quad4, std::vector{0, 1, 2, 3});
  CHECK(default_coincidence(mesh) == exactly(0.0005));
  CHECK(default_coincidence(Mesh{}) == 0.0);
}

TEST_CASE("uniform: one value for all nodes") {
  const auto relations = uniform(std::vector{2, 0, 1, 2}, Component::dy, origin);
  REQUIRE(relations.size() == 2);
  CHECK(relations[0].terms[0].node == 0);
  CHECK(relations[0].terms[1].node == 2);
  CHECK(relations[0].terms[1].coefficient == -1.0);
}

}  // namespace rigid_link_test
