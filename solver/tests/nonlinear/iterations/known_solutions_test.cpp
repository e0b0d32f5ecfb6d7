#include "solver/nonlinear/iterations/known_solutions.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace known_solutions_test {

/// A chain of springs, held at its beginning.
Eigen::MatrixXd chain(int size) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i) {
    matrix(i, i) = i + 1 < size ? 2.0 : 1.0;
    if (i > 0) matrix(i, i - 1) = matrix(i - 1, i) = -1.0;
  }
  return matrix;
}

TEST_CASE("A multiple of an earlier load takes the multiple of its solution, another load none") {
  const int size = 6;
  const Eigen::MatrixXd matrix = chain(size);
  const Eigen::VectorXd row_sizes = matrix.cwiseAbs().rowwise().sum();
  const Eigen::VectorXd pull = Eigen::VectorXd::Unit(size, size - 1), push = Eigen::VectorXd::Unit(size, 2);
  KnownSolutions known;
  known.add(pull, matrix.llt().solve(pull));
  known.add(push, matrix.llt().solve(push));

  Eigen::VectorXd load = -2.5 * pull;
  load[0] += 1e-16;  // rounding
  REQUIRE(known.take(load, row_sizes));
  CHECK((matrix * load + 2.5 * pull).cwiseAbs().maxCoeff() <= 1e-14);

  Eigen::VectorXd other = pull;
  other[0] += 1e-9;
  const Eigen::VectorXd same = other;
  CHECK_FALSE(known.take(other, row_sizes));
  CHECK(other == same);
  CHECK(known.take(other, row_sizes, Eigen::VectorXd::Constant(size, 2e-9)));
  Eigen::VectorXd nothing = Eigen::VectorXd::Zero(size);
  CHECK_FALSE(known.take(nothing, row_sizes));

  known.forget();
  load = pull;
  CHECK_FALSE(known.take(load, row_sizes));
}

TEST_CASE("The solution that was used longest ago is the first to be forgotten") {
  const int size = 6;
  const Eigen::MatrixXd matrix = chain(size);
  const Eigen::VectorXd row_sizes = matrix.cwiseAbs().rowwise().sum();
  KnownSolutions known;
  const auto knows = [&](int row) {
    Eigen::VectorXd load = Eigen::VectorXd::Unit(size, row);
    return known.take(load, row_sizes);
  };
  for (int row = 0; row < 4; ++row)
    known.add(Eigen::VectorXd::Unit(size, row), matrix.llt().solve(Eigen::VectorXd::Unit(size, row)));
  REQUIRE(knows(0));
  known.add(Eigen::VectorXd::Unit(size, 4), matrix.llt().solve(Eigen::VectorXd::Unit(size, 4)));
  CHECK(knows(0));
  CHECK_FALSE(knows(1));
}

}  // namespace known_solutions_test
