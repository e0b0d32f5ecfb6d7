#include "solver/unilateral/schur_complement.hpp"

#include <random>

#include <catch2/catch.hpp>

using namespace comma::solver;

TEST_CASE("Columns are A K^-1 A^T, solved for once each and in batches") {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(generator); };
  const int n = 30, m = 80;
  const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(n, n, draw);
  const Eigen::MatrixXd stiffness = half * half.transpose() + Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd rows = Eigen::MatrixXd::NullaryExpr(m, n, draw);
  const Eigen::LLT<Eigen::MatrixXd> factor(stiffness);
  long columns = 0, calls = 0;
  SchurComplement schur(rows.sparseView(), [&](Eigen::Ref<Eigen::MatrixXd> rhs) {
    ++calls;
    columns += rhs.cols();
    rhs = factor.solve(rhs).eval();
  });
  std::vector<int> wanted;
  for (int i = 0; i < 70; ++i) wanted.push_back(i);
  schur.require(wanted);
  schur.require(std::vector<int>{3, 5, 69});
  CHECK(columns == 70);
  CHECK(calls == 3);  // 32 + 32 + 6
  const Eigen::MatrixXd expected = rows * factor.solve(rows.transpose());
  for (const int i : wanted) CHECK((schur.column(i) - expected.col(i)).norm() < 1e-10 * expected.norm());

  SECTION("the same rows keep their columns") {
    schur.replace_rows(rows.sparseView());
    CHECK(schur.known(3));
  }
  SECTION("other rows do not") {
    schur.replace_rows((2.0 * rows).sparseView());
    CHECK_FALSE(schur.known(3));
  }
  SECTION("nor does a new factorisation") {
    schur.forget();
    CHECK_FALSE(schur.known(3));
  }
}

TEST_CASE("Rows that change are served by the compliance of their unknowns without a solve") {
  std::mt19937 generator(2);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(generator); };
  const int n = 50, m = 12;
  const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(n, n, draw);
  const Eigen::LLT<Eigen::MatrixXd> factor(half * half.transpose() + Eigen::MatrixXd::Identity(n, n));
  const std::vector<int> support = {3, 4, 10, 11, 12, 30, 41, 49};
  const auto random_rows = [&] {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(m, n);
    for (const int unknown : support) rows.col(unknown) = Eigen::VectorXd::NullaryExpr(m, draw);
    return rows;
  };
  long solves = 0;
  SchurComplement schur(random_rows().sparseView(),
                        [&](Eigen::Ref<Eigen::MatrixXd> rhs) {
                          solves += rhs.cols();
                          rhs = factor.solve(rhs).eval();
                        },
                        support);
  std::vector<int> all(m);
  for (int i = 0; i < m; ++i) all[i] = i;
  schur.require(all);
  CHECK(solves == m);
  for (int change = 0; change < 5; ++change) {
    const Eigen::MatrixXd rows = random_rows();
    schur.replace_rows(rows.sparseView());
    schur.require(all);
    const Eigen::MatrixXd expected = rows * factor.solve(rows.transpose());
    for (int i = 0; i < m; ++i) CHECK((schur.column(i) - expected.col(i)).norm() < 1e-11 * expected.norm());
  }
  CHECK(solves == m + static_cast<long>(support.size()));

  Eigen::MatrixXd elsewhere = random_rows();
  elsewhere(0, 20) = 1.0;  // off the support: solved for, and right all the same
  schur.replace_rows(elsewhere.sparseView());
  schur.require(std::vector<int>{0});
  CHECK((schur.column(0) - elsewhere * factor.solve(elsewhere.row(0).transpose())).norm() < 1e-10);
}
