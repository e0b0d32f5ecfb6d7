#include "solver/linear/bordered_compliance.hpp"

#include <catch2/catch.hpp>

using namespace comma::solver;

TEST_CASE("The border of a factorisation is the compliance of its rows") {
  // A chain of springs between two walls, some of them a million times stiffer.
  const int n = 60, m = 17;
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(n, n);
  for (int spring = 0; spring <= n; ++spring) {
    const double k = spring % 5 == 0 ? 1e6 : 1.0;
    if (spring < n) chain(spring, spring) += k;
    if (spring > 0) chain(spring - 1, spring - 1) += k;
    if (spring > 0 && spring < n) chain(spring, spring - 1) -= k;
  }
  const SymmetricMatrix stiffness = chain.sparseView();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(m, n);
  for (int row = 0; row < m; ++row) {
    rows(row, 3 * row) = 1.0;
    rows(row, (3 * row + 20) % n) = -0.25 * row;
  }
  const Eigen::MatrixXd full = chain.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd expected = rows * full.llt().solve(rows.transpose());
  const Eigen::MatrixXd compliance = bordered_compliance(stiffness, rows.sparseView());
  CHECK((compliance - expected).norm() < 1e-8 * expected.norm());  // the condition, 1e8, times a rounding
  CHECK((compliance - compliance.transpose()).norm() == 0.0);
}
