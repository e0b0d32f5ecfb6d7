#include "solver/linear/generalised_eigen.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "solver/tests/exactly.hpp"

using namespace comma::solver;

namespace {

/// The chain of n springs and masses whose eigenvalues are 4 sin^2(k pi / (2 (n + 1))).
SymmetricMatrix chain(int n) {
  SymmetricMatrix matrix(n, n);
  for (int i = 0; i < n; ++i) {
    matrix.insert(i, i) = 2.0;
    if (i + 1 < n) matrix.insert(i + 1, i) = -1.0;
  }
  matrix.makeCompressed();
  return matrix;
}

SymmetricMatrix signs(int n, int negative) {
  SymmetricMatrix matrix(n, n);
  for (int i = 0; i < n; ++i) matrix.insert(i, i) = i < negative ? -1.0 : 1.0;
  return matrix;
}

double exact(int k, int n) { return 4.0 * std::pow(std::sin(k * std::numbers::pi / (2.0 * (n + 1))), 2); }

}  // namespace

TEST_CASE("the smallest eigenvalues of a chain are those of the formula", "[linear]") {
  for (const int n : {30, 400}) {  // dense, sparse
    const SymmetricMatrix a = chain(n), b = signs(n, 0);
    const EigenPairs pairs = smallest_eigenvalues({a, nullptr, b}, 4);
    REQUIRE(pairs.values.size() == 4);
    for (int k = 0; k < 4; ++k) {
      CHECK(pairs.values[static_cast<std::size_t>(k)] == Approx(exact(k + 1, n)).epsilon(1e-8));
      const Eigen::VectorXd x = pairs.vectors.col(k);
      CHECK((a.selfadjointView<Eigen::Lower>() * x - pairs.values[static_cast<std::size_t>(k)] * x).norm() <= 1e-8);
      CHECK(x.maxCoeff() == exactly(1.0));
    }
  }
}

TEST_CASE("more eigenvalues may be asked for than iterations can find", "[linear]") {
  const SymmetricMatrix a = chain(130), b = signs(130, 0);
  for (const int count : {124, 126, 129, 130, 500})
    CHECK(smallest_eigenvalues({a, nullptr, b}, count).values.size() == static_cast<std::size_t>(std::min(count, 130)));
}

TEST_CASE("all eigenvalues of an interval are found, and none beyond", "[linear]") {
  for (const int n : {60, 300}) {
    const SymmetricMatrix a = chain(n), b = signs(n, 0);
    const double first = 0.5 * (exact(9, n) + exact(10, n)), last = 0.5 * (exact(29, n) + exact(30, n));
    const EigenPairs pairs = eigenvalues_between({a, nullptr, b}, first, last);
    REQUIRE(pairs.values.size() == 20);
    for (int k = 0; k < 20; ++k)
      CHECK(pairs.values[static_cast<std::size_t>(k)] == Approx(exact(k + 10, n)).epsilon(1e-8));
  }
}

TEST_CASE("eigenvalues of either sign come with a matrix of both signs", "[linear]") {
  for (const int n : {40, 400}) {
    const SymmetricMatrix a = chain(n), b = signs(n, n / 2);
    const EigenPairs pairs = smallest_eigenvalues({a, nullptr, b}, 4);
    REQUIRE(pairs.values.size() == 4);
    // The chain is its own mirror image, and b changes sign with it.
    CHECK(pairs.values[0] == exactly(-pairs.values[3]));
    CHECK(pairs.values[1] == exactly(-pairs.values[2]));
    CHECK(pairs.values[2] > 0.0);
  }
}

TEST_CASE("complex eigenvalues of an unsymmetric matrix are left out", "[linear]") {
  SymmetricMatrix a = signs(3, 0);
  a.coeffRef(2, 2) = 5.0;
  SkewMatrix skew(3, 3);
  skew.insert(1, 0) = 0.5;  // 1 + 0.5 i, 1 - 0.5 i
  const SymmetricMatrix b = signs(3, 0);
  const EigenPairs pairs = smallest_eigenvalues({a, &skew, b}, 3);
  REQUIRE(pairs.values.size() == 1);
  CHECK(pairs.values[0] == exactly(5.0));
}
