#include "solver/unilateral/active_cholesky.hpp"

#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "solver/linear/dense_solve.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

Eigen::MatrixXd random_spd(int size, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(generator); });
  return half * half.transpose() + Eigen::MatrixXd::Identity(size, size);
}

Eigen::VectorXd coupling(const Eigen::MatrixXd& s, const std::vector<int>& present, int row) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(present.size()));
  for (std::size_t i = 0; i < present.size(); ++i) values[static_cast<Eigen::Index>(i)] = s(present[i], row);
  return values;
}

}  // namespace

TEST_CASE("A factor that grew and shrank solves like a fresh one") {
  std::mt19937 generator(7);
  const int size = 40;
  const Eigen::MatrixXd s = random_spd(size, generator);
  ActiveCholesky factor;
  std::vector<int> present;
  for (int row = 0; row < size; ++row) {
    REQUIRE(factor.append(coupling(s, present, row), s(row, row)));
    present.push_back(row);
    if (row % 3 != 2) continue;
    const int gone = static_cast<int>(generator() % present.size());
    factor.remove(gone);
    present.erase(present.begin() + gone);
  }
  const Eigen::VectorXd rhs = Eigen::VectorXd::LinSpaced(factor.size(), -1.0, 2.0);
  const Eigen::MatrixXd sub = s(present, present);
  // Backward stable: the residual is a few roundings of |S| |x|.
  const Eigen::VectorXd x = factor.solve(rhs);
  CHECK((sub * x - rhs).norm() <= 1e-13 * sub.norm() * x.norm());
}

TEST_CASE("Rows that enter together give the factor of rows that enter in turn") {
  std::mt19937 generator(11);
  // Small blocks and large ones are factorised by different libraries.
  const int size = GENERATE(30, 240 + large_dense), first = GENERATE(12, large_dense + 10);
  if (first >= size) return;
  const Eigen::MatrixXd s = random_spd(size, generator);
  ActiveCholesky factor;
  REQUIRE(factor.append_all(Eigen::MatrixXd(first, 0), s.topLeftCorner(first, first)));
  REQUIRE(factor.append_all(s.bottomLeftCorner(size - first, first), s.bottomRightCorner(size - first, size - first)));
  REQUIRE(factor.size() == size);
  const Eigen::VectorXd rhs = Eigen::VectorXd::LinSpaced(size, -1.0, 2.0);
  const Eigen::VectorXd x = factor.solve(rhs);
  CHECK((s * x - rhs).norm() <= 1e-13 * s.norm() * x.norm());

  SECTION("and none of them enters where one depends on the others") {
    Eigen::MatrixXd twice(2, size);
    twice << s.row(3), s.row(3);
    REQUIRE_FALSE(factor.append_all(twice, Eigen::Matrix2d::Constant(s(3, 3))));
    CHECK(factor.size() == size);
    CHECK((factor.solve(rhs) - x).norm() == 0.0);
  }
}

TEST_CASE("A row that depends on those present is refused and leaves the factor alone") {
  ActiveCholesky factor;
  REQUIRE(factor.append(Eigen::VectorXd(), 4.0));
  REQUIRE_FALSE(factor.append(Eigen::VectorXd::Constant(1, 8.0), 16.0));
  CHECK(factor.size() == 1);
  CHECK(factor.solve(Eigen::VectorXd::Constant(1, 8.0))[0] == exactly(2.0));
}
