#include "solver/elements/solids/mixed_point.hpp"

#include <cmath>

#include "solver/error.hpp"
#include "solver/materials/behaviour/large_strain.hpp"

namespace comma::solver {

namespace {

using Eigen::Matrix3d;
using Vector7d = Eigen::Matrix<double, 7, 1>;

const Vector6d& trace() {
  static const Vector6d components = (Vector6d() << 1, 1, 1, 0, 0, 0).finished();
  return components;
}

/// det(I + H) - 1 by the invariants of H.
double volume_change(const Matrix3d& h) {
  const double second = h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0) + h(0, 0) * h(2, 2) - h(0, 2) * h(2, 0) +
                        h(1, 1) * h(2, 2) - h(1, 2) * h(2, 1);
  return h.trace() + second + h.determinant();
}

/// The derivative of the law's strain by (strain of the displacement, swelling).
using Gradient = Eigen::Matrix<double, 6, 7>;

MixedResponse small_response(const Matrix3d& gradient, double swelling, double pressure, const PointResponse& law) {
  Gradient g;
  g << Matrix6d::Identity() - trace() * trace().transpose() / 3.0, trace() / 3.0;
  const double mean = law.stress.head<3>().mean();
  MixedResponse result;
  result.stress = law.stress + (pressure - mean) * trace();
  result.swelling = mean - pressure;
  result.pressure = gradient.trace() - swelling;
  result.tangent.setZero();
  result.tangent.topLeftCorner<7, 7>().noalias() = g.transpose() * law.tangent * g;
  result.tangent.col(pressure_row).head<6>() = trace();
  return result;
}

/// A function of ln J, or the other way round, with its derivatives.
struct Curve {
  double value, slope, bend;
};

/// The measure at ln J.
Curve measure_of(double logarithm, VolumeMeasure measure) {
  if (measure == VolumeMeasure::logarithm) return {logarithm, 1.0, 0.0};
  return {std::expm1(logarithm), std::exp(logarithm), std::exp(logarithm)};
}

/// ln J of a swelling.
Curve logarithm_of(double swelling, VolumeMeasure measure) {
  if (measure == VolumeMeasure::logarithm) return {swelling, 1.0, 0.0};
  if (!(swelling > -1.0))
    throw Error("integration-failure", "a point has swollen to less than nothing: GONF is not above -1",
                "take smaller steps");
  const double slope = 1.0 / (1.0 + swelling);
  return {std::log1p(swelling), slope, -slope * slope};
}

double logarithm_of_volume(const Matrix3d& gradient) {
  deformation_gradient(gradient);  // which must not be turned inside out
  return std::log1p(volume_change(gradient));
}

/// With t = ln J of the swelling and a = (e^t / J)^(2/3): C~ = a C, so that dC~ / 2 = a dE + (dt - C^-1 : dE) / 3 C~.
MixedResponse large_response(const Matrix3d& gradient, double swelling, double pressure, const PointResponse& law,
                             VolumeMeasure measure) {
  const Matrix3d f = deformation_gradient(gradient);
  const Matrix3d c = f.transpose() * f;
  const Matrix3d inverse = c.inverse();
  const double logarithm = logarithm_of_volume(gradient);
  const Curve volume = measure_of(logarithm, measure), own = logarithm_of(swelling, measure);
  const double scale = std::exp(2.0 / 3.0 * (own.value - logarithm));
  const Vector6d normal = components_of_stress(inverse);  // the derivative of ln J by the strain
  Vector6d stretch = components_of_stress(scale * c);
  stretch.tail<3>() *= 2.0;
  const double kirchhoff = law.stress.dot(stretch);  // the trace
  Gradient g;
  g << scale * Matrix6d::Identity() - stretch * normal.transpose() / 3.0, stretch / 3.0;
  Vector7d change, stress;
  change << -normal, 1.0;
  stress << law.stress, 0.0;
  MixedResponse result;
  result.stress = scale * law.stress + (pressure * volume.slope - kirchhoff / 3.0) * normal;
  result.swelling = kirchhoff / 3.0 * own.slope - pressure;
  result.pressure = volume.value - swelling;
  result.tangent.setZero();
  auto tangent = result.tangent.topLeftCorner<7, 7>();
  tangent.noalias() = g.transpose() * law.tangent * g;
  tangent += 2.0 / 3.0 * scale * (change * stress.transpose() + stress * change.transpose());
  tangent += 2.0 / 9.0 * kirchhoff * change * change.transpose();
  tangent.topLeftCorner<6, 6>() += (pressure * volume.slope - kirchhoff / 3.0) * derivative_of_inverse(inverse);
  tangent.topLeftCorner<6, 6>() += pressure * volume.bend * normal * normal.transpose();
  tangent.row(swelling_row) *= own.slope;
  tangent.col(swelling_row) *= own.slope;
  tangent(swelling_row, swelling_row) += kirchhoff / 3.0 * own.bend;
  result.tangent.col(pressure_row).head<6>() = volume.slope * normal;
  return result;
}

}  // namespace

VolumeMeasure volume_measure(Kinematics kinematics) {
  if (kinematics == Kinematics::small) return VolumeMeasure::trace;
  return kinematics == Kinematics::multiplicative ? VolumeMeasure::ratio : VolumeMeasure::logarithm;
}

double volume_of(const Matrix3d& gradient, VolumeMeasure measure) {
  if (measure == VolumeMeasure::trace) return gradient.trace();
  return measure_of(logarithm_of_volume(gradient), measure).value;
}

Matrix3d with_volume(const Matrix3d& gradient, double swelling, VolumeMeasure measure) {
  if (measure == VolumeMeasure::trace) return gradient + (swelling - gradient.trace()) / 3.0 * Matrix3d::Identity();
  const double third = (logarithm_of(swelling, measure).value - logarithm_of_volume(gradient)) / 3.0;
  return std::exp(third) * gradient + std::expm1(third) * Matrix3d::Identity();
}

MixedResponse elastic_mixed_response(double bulk, double shear) {
  PointResponse law;
  law.stress.setZero();
  law.tangent = (Vector6d() << 2, 2, 2, 1, 1, 1).finished().asDiagonal();
  law.tangent *= shear;
  law.tangent += (bulk - 2.0 * shear / 3.0) * trace() * trace().transpose();
  return mixed_response(Matrix3d::Zero(), 0.0, 0.0, law, VolumeMeasure::trace);
}

double logarithm_slope(double swelling, VolumeMeasure measure) {
  return measure == VolumeMeasure::trace ? 1.0 : logarithm_of(swelling, measure).slope;
}

MixedResponse mixed_response(const Matrix3d& gradient, double swelling, double pressure, const PointResponse& law,
                             VolumeMeasure measure) {
  MixedResponse result = measure == VolumeMeasure::trace ? small_response(gradient, swelling, pressure, law)
                                                         : large_response(gradient, swelling, pressure, law, measure);
  result.tangent(swelling_row, pressure_row) = -1.0;
  result.tangent.row(pressure_row) = result.tangent.col(pressure_row).transpose();
  return result;
}

Matrix6d beginning_stiffness(const Matrix3d& gradient, double pressure) {
  const Matrix3d f = deformation_gradient(gradient);
  const Matrix3d inverse = (f.transpose() * f).inverse();
  const Vector6d normal = components_of_stress(inverse);
  return -pressure * (derivative_of_inverse(inverse) + 2.0 / 3.0 * normal * normal.transpose());
}

void eliminate_swelling(double bulk, MixedResponse& response) {
  response.swelling = 0.0;
  response.tangent.row(swelling_row).setZero();
  response.tangent.col(swelling_row).setZero();
  response.tangent(pressure_row, pressure_row) = -1.0 / bulk;
}

}  // namespace comma::solver
