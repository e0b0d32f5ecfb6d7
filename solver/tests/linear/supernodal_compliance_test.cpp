#include <cmath>

#include <catch2/catch.hpp>

#include "solver/linear/linear_solver.hpp"

using namespace comma::solver;

namespace {

/// Two blocks of springs that do not touch, each n x n x n, held by springs to the ground that grow weaker from node to
/// node.
SymmetricMatrix two_blocks(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto spring = [&](int a, int b, double k) {
    entries.emplace_back(a, a, k);
    entries.emplace_back(b, b, k);
    entries.emplace_back(std::max(a, b), std::min(a, b), -k);
  };
  const int block = n * n * n;
  for (int node = 0; node < 2 * block; ++node) {
    const int place = node % block, x = place % n, y = place / n % n, z = place / (n * n);
    entries.emplace_back(node, node, 1.0 / (1.0 + node));
    if (x + 1 < n) spring(node, node + 1, 1.0);
    if (y + 1 < n) spring(node, node + n, 2.0 + std::sin(node));
    if (z + 1 < n) spring(node, node + n * n, 10.0);
  }
  SymmetricMatrix matrix(2 * block, 2 * block);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

TEST_CASE("The compliance out of a Cholesky factor is that of a solution for each condition") {
  const int n = 14, block = n * n * n;
  const SymmetricMatrix matrix = two_blocks(n);
  const auto solver = make_linear_solver(LinearMethod::cholmod, {});
  REQUIRE(solver->factorise(matrix).verdict == FactorVerdict::ok);

  // Between the top of one block and the base of the other, one that touches a single block, and one that touches
  // nothing.
  std::vector<Eigen::Triplet<double>> entries;
  const int conditions = n * n + 2;
  for (int k = 0; k < n * n; ++k) {
    entries.emplace_back(k, block - n * n + k, 1.0);
    entries.emplace_back(k, block + k, -0.7);
    entries.emplace_back(k, block + (k + 1) % (n * n), -0.3);
  }
  entries.emplace_back(n * n, block / 2, 2.5);
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows(conditions, 2 * block);
  rows.setFromTriplets(entries.begin(), entries.end());

  const Eigen::MatrixXd compliance = solver->compliance(rows);
  REQUIRE(compliance.rows() == conditions);
  Eigen::MatrixXd columns = rows.transpose();
  solver->solve(columns);
  const Eigen::MatrixXd expected = rows * columns;
  CHECK((compliance - expected).norm() < 1e-12 * expected.norm());
  CHECK((compliance - compliance.transpose()).norm() == 0.0);
  CHECK(compliance.row(conditions - 1).norm() == 0.0);
  CHECK_FALSE(solver->factorises_for_compliance());
}

TEST_CASE("Conditions on few unknowns of a block get their compliance from that of the unknowns") {
  const int n = 14, block = n * n * n;
  const SymmetricMatrix matrix = two_blocks(n);
  const auto solver = make_linear_solver(LinearMethod::cholmod, {});
  REQUIRE(solver->factorise(matrix).verdict == FactorVerdict::ok);

  // The top of one block against a third as many unknowns of the other; the last conditions are on one block alone.
  std::vector<Eigen::Triplet<double>> entries;
  const int conditions = n * n;
  for (int k = 0; k < conditions; ++k) {
    entries.emplace_back(k, block - n * n + k, 1.0);
    if (k > conditions - 5) continue;
    entries.emplace_back(k, block + k / 3, -0.7);
    entries.emplace_back(k, block + k / 3 + 1, -0.3 - 0.01 * (k % 3));
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows(conditions, 2 * block);
  rows.setFromTriplets(entries.begin(), entries.end());

  const Eigen::MatrixXd compliance = solver->compliance(rows);
  Eigen::MatrixXd columns = rows.transpose();
  solver->solve(columns);
  const Eigen::MatrixXd expected = rows * columns;
  CHECK((compliance - expected).norm() < 1e-12 * expected.norm());
  CHECK((compliance - compliance.transpose()).norm() == 0.0);
}

TEST_CASE("MUMPS gives the same compliance with a border") {
  const SymmetricMatrix matrix = two_blocks(5);
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows(2, matrix.rows());
  rows.insert(0, 3) = 1.0;
  rows.insert(0, 200) = -1.0;
  rows.insert(1, 130) = 4.0;
  const auto solver = make_linear_solver(LinearMethod::mumps, {});
  REQUIRE(solver->factorise(matrix).verdict == FactorVerdict::ok);
  Eigen::MatrixXd columns = rows.transpose();
  const Eigen::MatrixXd compliance = solver->compliance(rows);
  solver->solve(columns);
  const Eigen::MatrixXd expected = rows * columns;
  CHECK((compliance - expected).norm() < 1e-12 * expected.norm());
  CHECK(solver->factorises_for_compliance());
}

TEST_CASE("A solver without a supernodal factor leaves the compliance to its solutions") {
  const SymmetricMatrix matrix = two_blocks(3);
  const auto solver = make_linear_solver(LinearMethod::eigen_ldlt, {});
  solver->factorise(matrix);
  CHECK(solver->compliance(Eigen::SparseMatrix<double, Eigen::RowMajor>(1, matrix.rows())).size() == 0);
}
