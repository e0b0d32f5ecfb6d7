#include "solver/materials/elasticity.hpp"

#include <limits>

#include <catch2/catch.hpp>

#include "solver/error.hpp"

using namespace comma::solver;

namespace {

const IsotropicModuli steel{2.1e11, 0.3};

}  // namespace

TEST_CASE("uniaxial stress gives E and Poisson's ratio back", "[materials]") {
  const Eigen::Matrix<double, 6, 1> strain = solid_stiffness(steel).ldlt().solve(Eigen::Matrix<double, 6, 1>::Unit(0));
  CHECK(strain[0] == Approx(1.0 / steel.young));
  CHECK(strain[1] == Approx(-steel.poisson / steel.young));
  CHECK(strain[2] == Approx(-steel.poisson / steel.young));
}

TEST_CASE("plane stress is the three-dimensional law with no stress across the plane", "[materials]") {
  const Eigen::Matrix4d law = solid_stiffness(steel).topLeftCorner<4, 4>();
  Eigen::Matrix4d condensed = law - law.col(2) * law.row(2) / law(2, 2);
  CHECK((condensed - plane_stress_stiffness(steel)).cwiseAbs().maxCoeff() < 1e-14 * steel.young);
}

TEST_CASE("constants without an elastic body behind them are refused", "[materials]") {
  CHECK_NOTHROW(check_elasticity(steel));
  CHECK_NOTHROW(check_elasticity({1.0, 0.0}));
  for (const auto& wrong : {IsotropicModuli{0.0, 0.3}, IsotropicModuli{-1.0, 0.3}, IsotropicModuli{1.0, 0.5},
                            IsotropicModuli{1.0, -1.0}, IsotropicModuli{std::numeric_limits<double>::quiet_NaN(), 0.0}}) {
    CHECK_THROWS_AS(check_elasticity(wrong), Error);
  }
}
