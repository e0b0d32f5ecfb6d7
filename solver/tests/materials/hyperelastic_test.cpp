#include <catch2/catch.hpp>

#include <cmath>

#include "solver/error.hpp"
#include "solver/materials/behaviour/hyperelastic.hpp"
#include "solver/materials/behaviour/large_strain.hpp"
#include "solver/materials/behaviour/point_law.hpp"

using namespace comma::solver;
using Eigen::Matrix3d;

namespace hyperelastic_test {

constexpr Hyperelasticity rubber{0.7, 0.25, 0.05, 40.0};

Matrix3d rough(double amplitude) {
  Matrix3d h;
  for (int k = 0; k < 9; ++k) h(k / 3, k % 3) = amplitude * std::sin(1.0 + 2.3 * k);
  return h;
}

double energy(const Matrix3d& h) { return hyperelastic_energy(rubber, h); }

Vector6d strain_of(const Matrix3d& h) {
  Vector6d e = components_of_stress(green_lagrange_strain(h));
  e.tail<3>() *= 2.0;
  return e;
}

TEST_CASE("the stress of rubber is the derivative of its energy, and its tangent that of the stress") {
  const Matrix3d h = rough(0.3);
  const HyperelasticResponse response = hyperelastic_response(rubber, h);
  constexpr double step = 1e-5;
  for (int k = 0; k < 9; ++k) {
    Matrix3d direction = Matrix3d::Zero();
    direction(k / 3, k % 3) = step;
    const Vector6d strain = strain_of(h + direction) - strain_of(h - direction);
    // Central differences err by step^2 times third derivatives, which the bulk modulus sets.
    CHECK(energy(h + direction) - energy(h - direction) ==
          Approx(response.stress.dot(strain)).margin(1e-7 * step * rubber.bulk));
    const Vector6d change =
        hyperelastic_response(rubber, h + direction).stress - hyperelastic_response(rubber, h - direction).stress;
    CHECK((change - response.tangent * strain).cwiseAbs().maxCoeff() < 1e-7 * step * 100.0 * rubber.bulk);
  }
}

TEST_CASE("nearly incompressible rubber is pulled as Mooney and Rivlin have it") {
  Hyperelasticity stiff = rubber;
  stiff.c20 = 0.0;
  stiff.bulk = 1e7;
  constexpr double stretch = 2.0;
  Matrix3d h = Matrix3d::Zero();
  double side = 1.0 / std::sqrt(stretch) - 1.0;
  const auto at = [&](double across) {
    h.diagonal() << stretch - 1.0, across, across;
    return hyperelastic_response(stiff, h);
  };
  for (int iteration = 0; iteration < 20; ++iteration) {
    constexpr double step = 1e-8;
    side -= at(side).stress[1] * 2 * step / (at(side + step).stress[1] - at(side - step).stress[1]);
  }
  const double nominal = stretch * at(side).stress[0];
  // 2 (C10 + C01 / stretch) (stretch - 1 / stretch^2), but for the last compressibility.
  CHECK(nominal ==
        Approx(2.0 * (stiff.c10 + stiff.c01 / stretch) * (stretch - 1.0 / (stretch * stretch))).epsilon(1e-5));
}

TEST_CASE("rubber at rest has the moduli of small strains") {
  const IsotropicModuli moduli = small_strain_moduli(rubber);
  const Matrix6d tangent = hyperelastic_response(rubber, Matrix3d::Zero()).tangent;
  CHECK((tangent - solid_stiffness(moduli)).cwiseAbs().maxCoeff() < 1e-13 * rubber.bulk);
}

TEST_CASE(
    "rubber in plane stress: nothing acts across, pulled one way it is the bar of three dimensions, and the tangent is "
    "the stress's") {
  const PointLaw law({Kinematics::green_lagrange, Relation::hyperelastic}, true);
  PlasticPoint constants;
  constants.hyperelasticity = &rubber;
  const PointPast past;
  const Vector6d none = Vector6d::Zero();
  const auto at = [&](const Matrix3d& h) { return law.respond({h, none, constants, past}); };
  const auto in_plane = [](double amplitude) {
    Matrix3d h = rough(amplitude);
    h.row(2).setZero();
    h.col(2).setZero();
    return h;
  };
  for (const double amplitude : {0.15, 0.3}) {
    const Matrix3d h = in_plane(amplitude);
    const PointResponse response = at(h);
    CHECK(std::abs(hyperelastic_response(rubber, gradient_in_plane_stress(rubber, h)).stress[2]) < 1e-13 * rubber.bulk);
    CHECK(std::abs(response.reported[2]) == 0.0);
    constexpr double step = 1e-5;
    for (const auto& [row, column] : {std::pair(0, 0), std::pair(0, 1), std::pair(1, 0), std::pair(1, 1)}) {
      Matrix3d direction = Matrix3d::Zero();
      direction(row, column) = step;
      const Vector6d strain = strain_of(h + direction) - strain_of(h - direction);
      const Vector6d change = at(h + direction).stress - at(h - direction).stress;
      CHECK((change - response.tangent * strain).cwiseAbs().maxCoeff() < 1e-7 * step * 100.0 * rubber.bulk);
      CHECK(hyperelastic_energy(rubber, gradient_in_plane_stress(rubber, h + direction)) -
                hyperelastic_energy(rubber, gradient_in_plane_stress(rubber, h - direction)) ==
            Approx(response.stress.dot(strain)).margin(1e-7 * step * rubber.bulk));
    }
  }
  Matrix3d bar = Matrix3d::Zero();
  bar(0, 0) = 1.0;
  bar(1, 1) = 1.0 / std::sqrt(2.0) - 1.0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const PointResponse response = at(bar);
    bar(1, 1) =
        std::sqrt((1.0 + bar(1, 1)) * (1.0 + bar(1, 1)) - 2.0 * response.stress[1] / response.tangent(1, 1)) - 1.0;
  }
  // As thick as it is wide.
  CHECK(gradient_in_plane_stress(rubber, bar)(2, 2) == Approx(bar(1, 1)).epsilon(1e-12));
  bar(0, 0) = -2.0;
  CHECK_THROWS_AS(at(bar), Error);
}

}  // namespace hyperelastic_test
