#include "solver/linear/gmres.hpp"

#include <random>
#include <vector>

#include <catch2/catch.hpp>

using namespace comma::solver;

namespace {

Eigen::VectorXd same(const Eigen::VectorXd& x) { return x; }

}  // namespace

TEST_CASE("Minimal residuals solve an unsymmetric system, and say which of the vectors they were given it is made of") {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  const int n = 60;
  const auto draw = [&] { return normal(generator); };
  const Eigen::MatrixXd matrix = 10.0 * Eigen::MatrixXd::Identity(n, n) + Eigen::MatrixXd::NullaryExpr(n, n, draw);
  const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(n, draw);
  std::vector<Eigen::VectorXd> given;
  const LinearMap products = [&](const Eigen::VectorXd& x) {
    given.push_back(x);
    return Eigen::VectorXd(matrix * x);
  };
  const Eigen::VectorXd diagonal = matrix.diagonal();
  const LinearMap scaling = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(x.cwiseQuotient(diagonal)); };
  const GmresSolution solution = solve_gmres(products, scaling, b, {.tolerance = 1e-12, .most_products = n});
  REQUIRE(solution.reached);
  CHECK((matrix * solution.x - b).norm() < 2e-12 * b.norm());
  CHECK(given.size() < n);
  Eigen::VectorXd combined = Eigen::VectorXd::Zero(n);
  for (std::size_t k = 0; k < given.size(); ++k) combined += solution.shares[static_cast<Eigen::Index>(k)] * given[k];
  CHECK((combined - solution.x).norm() == 0.0);
}

TEST_CASE("Minimal residuals of a permutation stay until the last product, and are not a solution before") {
  const int n = 20;
  const LinearMap shift = [](const Eigen::VectorXd& x) {
    Eigen::VectorXd y(x.size());
    y << x.tail(x.size() - 1), x[0];
    return y;
  };
  const Eigen::VectorXd b = Eigen::VectorXd::Unit(n, 0);
  CHECK_FALSE(solve_gmres(shift, same, b, {.tolerance = 1e-10, .most_products = n - 1}).reached);
  CHECK(solve_gmres(shift, same, b, {.tolerance = 1e-10, .most_products = n}).reached);
}

TEST_CASE("Minimal residuals end where products give nothing new") {
  const LinearMap projection = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(x[0] * Eigen::VectorXd::Unit(3, 0));
  };
  const GmresSolution none =
      solve_gmres(projection, same, Eigen::Vector3d(1.0, 1.0, 0.0), {.tolerance = 1e-10, .most_products = 10});
  CHECK_FALSE(none.reached);
  CHECK(solve_gmres(projection, same, Eigen::Vector3d(2.0, 0.0, 0.0), {.tolerance = 1e-10, .most_products = 10}).x ==
        Eigen::Vector3d(2.0, 0.0, 0.0));
  CHECK(solve_gmres(projection, same, Eigen::Vector3d::Zero(), {.tolerance = 1e-10, .most_products = 10}).reached);
}
