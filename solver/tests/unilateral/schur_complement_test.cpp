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
