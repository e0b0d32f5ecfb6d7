#include <catch2/catch.hpp>

#include <cmath>

#include "solver/error.hpp"
#include "solver/materials/behaviour/logarithmic_strain.hpp"
#include "solver/materials/behaviour/point_law.hpp"
#include "solver/tests/exactly.hpp"

using namespace comma::solver;
using Eigen::Matrix3d;

namespace {

Matrix3d rough(double amplitude) {
  Matrix3d h;
  for (int k = 0; k < 9; ++k) h(k / 3, k % 3) = amplitude * std::sin(1.0 + 2.3 * k);
  return h;
}

Vector6d green(const Matrix3d& h) {
  Vector6d e = components_of_stress(0.5 * (h + h.transpose() + h.transpose() * h));
  e.tail<3>() *= 2.0;
  return e;
}

PlasticPoint metal() {
  Plasticity plasticity;
  plasticity.linear = LinearHardening{2e3, 250.0};
  return plastic_point(IsotropicElasticity{200e3, 0.3}, plasticity, Relation::isotropic_linear, MaterialPoint());
}

}  // namespace

TEST_CASE("a stretch along turned axes has the logarithms of the stretches as strains") {
  const Matrix3d axes = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.3, 1, 2).normalized()).toRotationMatrix();
  const Eigen::Vector3d stretches(1.4, 0.8, 1.05);
  const Matrix3d f = turn * axes * stretches.asDiagonal() * axes.transpose();
  const LogarithmicStrain strain(f - Matrix3d::Identity());
  Vector6d expected = components_of_stress(axes * stretches.array().log().matrix().asDiagonal() * axes.transpose());
  expected.tail<3>() *= 2.0;
  CHECK((strain.strain() - expected).norm() < 1e-14);
}

TEST_CASE("small strains do not drown in the rounding of 1") {
  Matrix3d h = Matrix3d::Zero();
  h(0, 0) = 1e-13;
  CHECK(LogarithmicStrain(h).strain()[0] == Approx(1e-13).epsilon(1e-10));
}

TEST_CASE(
    "the second stress does the work of T, and its tangent is its derivative, with equal and with different "
    "stretches") {
  const PointLaw law({Kinematics::logarithmic, Relation::isotropic_linear}, false);
  const PlasticPoint constants = metal();
  const Vector6d nothing = Vector6d::Zero();
  Matrix3d equal = Matrix3d::Zero();
  equal.diagonal().setConstant(0.02);
  Matrix3d nearly = rough(1e-5);
  nearly(0, 0) += 0.3;
  for (const Matrix3d& h : {rough(0.2), equal, nearly, Matrix3d(rough(0.2) + equal)}) {
    PointPast past;
    past.moduli = constants;
    past.gradient = 0.5 * rough(0.1);
    const auto at = [&](const Matrix3d& gradient) { return law.respond({gradient, nothing, constants, past}); };
    const PointResponse response = at(h);
    constexpr double step = 1e-6;
    for (int k = 0; k < 9; ++k) {
      Matrix3d direction = Matrix3d::Zero();
      direction(k / 3, k % 3) = step;
      const Vector6d change = at(h + direction).stress - at(h - direction).stress;
      const Vector6d strain = green(h + direction) - green(h - direction);
      CHECK((change - response.tangent * strain).cwiseAbs().maxCoeff() < 1e-6 * step * 200e3);
    }
    // The rate of work of S on the Green-Lagrange strain is that of T on the logarithmic one.
    const Matrix3d towards = step * rough(1.0).transpose();
    const Eigen::Map<const Vector6d> t(response.variables.data() + 2);
    const double own = response.stress.dot(green(h + towards) - green(h - towards));
    const double of_logarithm =
        t.dot(LogarithmicStrain(h + towards).strain() - LogarithmicStrain(h - towards).strain());
    CHECK(own == Approx(of_logarithm).epsilon(1e-6).margin(1e-9));
  }
}

TEST_CASE("Cauchy's stress of a pulled bar in large strains is the traction curve over ln(length)") {
  const PointLaw law({Kinematics::logarithmic, Relation::isotropic_linear}, false);
  const PlasticPoint constants = metal();
  const Vector6d nothing = Vector6d::Zero();
  PointPast past;
  past.moduli = constants;
  constexpr double stretch = 1.5;
  // The contraction that leaves the sides free.
  double side = -0.18;
  Matrix3d h = Matrix3d::Zero();
  const auto at = [&](double across) {
    h.diagonal() << stretch - 1.0, across, across;
    return law.respond({h, nothing, constants, past});
  };
  for (int iteration = 0; iteration < 50; ++iteration) {
    constexpr double step = 1e-7;
    const double slope = (at(side + step).stress[1] - at(side - step).stress[1]) / (2 * step);
    side -= at(side).stress[1] / slope;
  }
  const PointResponse response = at(side);
  // T = sigma J with T = 250 + 2e3 (ln 1.5 - 250 / 200e3).
  const double kirchhoff = 250.0 + 2e3 * (std::log(stretch) - 250.0 / 200e3);
  CHECK(response.reported[0] * stretch * (1 + side) * (1 + side) == exactly(kirchhoff));
}

TEST_CASE("turning inside out is an error") {
  Matrix3d h = Matrix3d::Zero();
  h(1, 1) = -1.5;
  CHECK_THROWS_WITH(LogarithmicStrain(h), Catch::Contains("inside out"));
}
