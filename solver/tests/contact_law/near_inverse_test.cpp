#include "solver/contact_law/near_inverse.hpp"

#include <catch2/catch.hpp>

#include "solver/tests/contact_law/coupled_points.hpp"

namespace comma::solver {
namespace {

/// A block a point, whose coefficients differ from point to point and from component to component.
std::vector<ForceBlock> blocks_of(int count) {
  std::vector<ForceBlock> blocks(static_cast<std::size_t>(count));
  for (int p = 0; p < count; ++p) {
    ForceBlock& block = blocks[static_cast<std::size_t>(p)];
    block.place = block.row = 3 * p;
    block.size = 3;
    block.by_force = Eigen::Vector3d(0.1, 0.2 + 0.01 * p, 0.3).asDiagonal();
    block.by_jump << 1.0, 0.1, 0.0, 0.05 * p, 1.0, 0.0, 0.0, -0.1, 1.0;
  }
  return blocks;
}

Eigen::MatrixXd system(SchurComplement& schur, const std::vector<ForceBlock>& blocks) {
  const auto size = static_cast<Eigen::Index>(3 * blocks.size());
  Eigen::MatrixXd by_force = Eigen::MatrixXd::Zero(size, size), by_jump = by_force, compliance(size, size);
  for (const ForceBlock& block : blocks) {
    by_force.block<3, 3>(block.place, block.place) = block.by_force;
    by_jump.block<3, 3>(block.place, block.place) = block.by_jump;
  }
  for (Eigen::Index column = 0; column < size; ++column)
    compliance.col(column) = schur.times(Eigen::VectorXd::Unit(size, column));
  return by_force + by_jump * compliance;
}

}  // namespace

TEST_CASE("What is seen from near each point is the inverse where all points are near") {
  Coupled coupled(NearInverse::neighbours + 1, 0.3);
  std::vector<ForceBlock> blocks = blocks_of(NearInverse::neighbours + 1);
  const Eigen::MatrixXd matrix = system(coupled.schur, blocks);
  NearInverse inverse;
  inverse.update(coupled.schur, blocks);
  const Eigen::VectorXd solution = Eigen::VectorXd::LinSpaced(matrix.rows(), -1.0, 2.0);
  CHECK((inverse(matrix * solution) - solution).norm() < 1e-11 * solution.norm());

  // Small changes leave it as it is, larger ones make the rows around them anew.
  const Eigen::VectorXd before = inverse(solution);
  blocks.front().by_force *= 1.1;
  inverse.update(coupled.schur, blocks);
  CHECK(inverse(solution) == before);
  blocks.front().by_force *= 3.0;
  inverse.update(coupled.schur, blocks);
  const Eigen::MatrixXd changed = system(coupled.schur, blocks);
  CHECK((inverse(changed * solution) - solution).norm() < 1e-11 * solution.norm());
}

TEST_CASE("Where points are many it is near the inverse, and a step with it leaves less") {
  constexpr int count = 3 * NearInverse::neighbours;
  Coupled coupled(count, 0.3);
  const std::vector<ForceBlock> blocks = blocks_of(count);
  const Eigen::MatrixXd matrix = system(coupled.schur, blocks);
  NearInverse inverse;
  inverse.update(coupled.schur, blocks);
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(matrix.rows(), -1.0, 2.0);
  const Eigen::VectorXd left = right - matrix * inverse(right);
  CHECK(left.norm() < 0.3 * right.norm());
  CHECK(left.norm() > 1e-6 * right.norm());
}

}  // namespace comma::solver
