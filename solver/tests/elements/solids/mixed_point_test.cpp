#include <catch2/catch.hpp>

#include <cmath>

#include "solver/elements/solids/mixed_point.hpp"
#include "solver/error.hpp"
#include "solver/materials/behaviour/large_strain.hpp"

using namespace comma::solver;
using Eigen::Matrix3d;

namespace mixed_point_test {

constexpr double young = 2000.0;
constexpr double poisson = 0.3;
constexpr double bulk = young / (3.0 * (1.0 - 2.0 * poisson));

Matrix3d rough(double amplitude, double phase = 1.0) {
  Matrix3d h;
  for (int k = 0; k < 9; ++k) h(k / 3, k % 3) = amplitude * std::sin(phase + 2.3 * k);
  return h;
}

PlasticPoint metal() {
  Plasticity plasticity;
  plasticity.linear = LinearHardening{100.0, 30.0};
  return plastic_point(IsotropicElasticity{young, poisson}, plasticity, Relation::isotropic_linear, MaterialPoint());
}

/// A point that starts without stress.
struct At {
  Kinematics kinematics;
  bool two_fields = true;

  MixedResponse operator()(const Matrix3d& h, double swelling, double pressure) const {
    const PointLaw law({kinematics, Relation::isotropic_linear}, false);
    const PlasticPoint constants = metal();
    const Vector6d nothing = Vector6d::Zero();
    PointPast past;
    past.moduli = constants;
    const VolumeMeasure measure = volume_measure(kinematics);
    const double trace = two_fields ? swelling : pressure / bulk;
    const Matrix3d given = with_volume(h, trace, measure);
    MixedResponse response =
        mixed_response(h, trace, pressure, law.respond({given, nothing, constants, past}), measure);
    if (!two_fields) eliminate_swelling(bulk, response);
    return response;
  }
};

Eigen::Matrix<double, 8, 1> worked(const MixedResponse& r) {
  Eigen::Matrix<double, 8, 1> all;
  all << r.stress, r.swelling, r.pressure;
  return all;
}

Vector6d strain_of(const Matrix3d& h, bool large) {
  Vector6d strain = components_of_stress(large ? green_lagrange_strain(h) : Matrix3d(0.5 * (h + h.transpose())));
  strain.tail<3>() *= 2.0;
  return strain;
}

TEST_CASE("a gradient keeps its shape and takes the volume strain that it is given") {
  const Matrix3d h = rough(0.2);
  const Matrix3d small = with_volume(h, 0.03, VolumeMeasure::trace);
  CHECK(small.trace() == Approx(0.03).epsilon(1e-14));
  CHECK((small - h - (0.03 - h.trace()) / 3.0 * Matrix3d::Identity()).norm() < 1e-15);
  const Matrix3d large = with_volume(h, 0.03, VolumeMeasure::logarithm);
  const Matrix3d f = Matrix3d::Identity() + h, changed = Matrix3d::Identity() + large;
  CHECK(std::log(changed.determinant()) == Approx(0.03).epsilon(1e-13));
  CHECK((changed / std::cbrt(changed.determinant()) - f / std::cbrt(f.determinant())).norm() < 1e-14);
  CHECK(volume_of(with_volume(h, 0.03, VolumeMeasure::ratio), VolumeMeasure::ratio) == Approx(0.03).epsilon(1e-13));
  CHECK_THROWS_AS(volume_of(-2.0 * Matrix3d::Identity(), VolumeMeasure::ratio), Error);
  CHECK_THROWS_AS(with_volume(h, -1.0, VolumeMeasure::ratio), Error);
}

TEST_CASE("the volume strain of a small gradient does not drown in the rounding of 1") {
  Matrix3d h = Matrix3d::Zero();
  h(1, 1) = 3e-14;
  CHECK(volume_of(h, VolumeMeasure::logarithm) == Approx(3e-14).epsilon(1e-12));
}

TEST_CASE(
    "the tangent of a mixed point is the derivative of what works, elastic and flowing, with two fields and with one") {
  const auto [kinematics, two_fields] = GENERATE(
      std::pair{Kinematics::small, true}, std::pair{Kinematics::small, false}, std::pair{Kinematics::logarithmic, true},
      std::pair{Kinematics::logarithmic, false}, std::pair{Kinematics::multiplicative, true});
  const double amplitude = GENERATE(0.002, 0.15);  // below and above yield
  const bool large = kinematics != Kinematics::small;
  const At at{kinematics, two_fields};
  const Matrix3d h = rough(amplitude);
  const double swelling = 0.7 * amplitude, pressure = 40.0;
  const auto tangent = at(h, swelling, pressure).tangent;
  const bool symmetric = (tangent - tangent.transpose()).norm() < 1e-12 * tangent.norm();
  CHECK(symmetric == (kinematics != Kinematics::multiplicative || amplitude < 0.01));
  constexpr double step = 1e-6;
  for (int k = 0; k < 9; ++k) {
    Matrix3d direction = Matrix3d::Zero();
    direction(k / 3, k % 3) = 1.0;
    const Matrix3d ahead = h + step * direction, behind = h - step * direction;
    Eigen::Matrix<double, 8, 1> change = Eigen::Matrix<double, 8, 1>::Zero();
    change.head<6>() = (strain_of(ahead, large) - strain_of(behind, large)) / (2.0 * step);
    const Eigen::Matrix<double, 8, 1> found =
        (worked(at(ahead, swelling, pressure)) - worked(at(behind, swelling, pressure))) / (2.0 * step);
    CHECK((tangent * change - found).norm() < 1e-5 * young);
  }
  const Eigen::Matrix<double, 8, 1> by_swelling =
      (worked(at(h, swelling + step, pressure)) - worked(at(h, swelling - step, pressure))) / (2.0 * step);
  CHECK((tangent.col(6) - by_swelling).norm() < 1e-5 * young);
  const Eigen::Matrix<double, 8, 1> by_pressure =
      (worked(at(h, swelling, pressure + 1e-3)) - worked(at(h, swelling, pressure - 1e-3))) / 2e-3;
  CHECK((tangent.col(7) - by_pressure).norm() < 1e-7);
}

TEST_CASE("where swelling and pressure are those of the law itself, the stress is the law's") {
  const auto kinematics = GENERATE(Kinematics::small, Kinematics::logarithmic, Kinematics::multiplicative);
  const PointLaw law({kinematics, Relation::isotropic_linear}, false);
  const PlasticPoint constants = metal();
  const Vector6d nothing = Vector6d::Zero();
  PointPast past;
  past.moduli = constants;
  const Matrix3d h = rough(0.1);
  const PointResponse own = law.respond({h, nothing, constants, past});
  const VolumeMeasure measure = volume_measure(kinematics);
  const double ratio = measure == VolumeMeasure::logarithm ? 1.0 + volume_of(h, VolumeMeasure::ratio)
                                                           : 1.0;  // of Kirchhoff's stress to Cauchy's
  const MixedResponse response =
      mixed_response(h, volume_of(h, measure), ratio * own.reported.head<3>().mean(), own, measure);
  CHECK((response.stress - own.stress).norm() < 1e-12 * own.stress.norm());
  CHECK(std::abs(response.swelling) < 1e-12 * own.stress.norm());
  CHECK(std::abs(response.pressure) < 1e-15);
}

}  // namespace mixed_point_test
