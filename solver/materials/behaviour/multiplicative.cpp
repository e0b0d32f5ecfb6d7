#include "solver/materials/behaviour/multiplicative.hpp"

#include <algorithm>
#include <cmath>

#include "solver/materials/behaviour/large_strain.hpp"
#include "solver/materials/behaviour/von_mises.hpp"

namespace comma::solver {

namespace {

using Eigen::Matrix3d;

/// What trial and flow are made from, on the initial geometry: C = F^T F, and G = C_p^-1, which the step begins with.
/// All derivatives are by the strain E, where dC = 2 dE: those of scalars are stresses in form.
struct Trial {
  double jacobian;
  double shape;      ///< J^(-2/3)
  Vector6d inverse;  ///< C^-1
  Vector6d plastic;  ///< G
  double trace;      ///< t = J^(-2/3) C : G
  Vector6d trace_slope;
  double size;  ///< sqrt(3/2) |tau| of the trial
  Vector6d size_slope;
  Vector6d stress;   ///< of the deviator, on the initial geometry
  Matrix6d tangent;  ///< of that

  Trial(const PlasticPoint& point, const Matrix3d& f, const Matrix3d& g) {
    const Matrix3d c = f.transpose() * f;
    const Matrix3d c_inverse = c.inverse();
    const Matrix3d gcg = g * c * g;
    const double contraction = c.cwiseProduct(g).sum();
    jacobian = f.determinant();
    shape = std::pow(jacobian, -2.0 / 3.0);
    inverse = components_of_stress(c_inverse);
    plastic = components_of_stress(g);
    trace = shape * contraction;
    trace_slope = 2.0 * (shape * plastic - trace / 3.0 * inverse);
    const double factor = 1.5 * point.shear * point.shear * shape * shape;
    size = std::sqrt(std::max(0.0, factor * (c.cwiseProduct(gcg).sum() - contraction * contraction / 3.0)));
    size_slope = Vector6d::Zero();
    if (size > 0.0) {
      const Vector6d by_c = factor * (2.0 * components_of_stress(gcg) - 2.0 / 3.0 * contraction * plastic) -
                            2.0 / 3.0 * size * size * inverse;
      size_slope = by_c / size;
    }
    stress = point.shear * (shape * plastic - trace / 3.0 * inverse);
    tangent = -point.shear / 3.0 *
              (2.0 * shape * plastic * inverse.transpose() + inverse * trace_slope.transpose() +
               trace * derivative_of_inverse(c_inverse));
  }
};

/// m with det(D + m I) = 1 for a deviator D: the return must not change the volume of b.
double mean_of_unit_volume(const Matrix3d& deviator) {
  const double half_square = 0.5 * deviator.squaredNorm();
  const double rest = deviator.determinant() - 1.0;
  double mean = 1.0 + std::sqrt(half_square /
                                3.0);  // right of the largest turning point, where Newton's method falls onto the root
  constexpr int most_iterations = 60;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const double step = (mean * (mean * mean - half_square) + rest) / (3.0 * mean * mean - half_square);
    mean -= step;
    if (std::abs(step) <= 1e-15 * mean) break;
  }
  return mean;
}

void add_volume(const PlasticPoint& point, double expansion, const Trial& trial, const Matrix3d& f,
                MultiplicativeResponse& response) {
  const double j = trial.jacobian;
  const double pressure = 0.5 * point.bulk * (j * j - 1.0) - 1.5 * point.bulk * expansion * (j + 1.0 / j);
  const double slope = point.bulk * j - 1.5 * point.bulk * expansion * (1.0 - 1.0 / (j * j));
  response.stress += pressure * trial.inverse;
  response.tangent += slope * j * trial.inverse * trial.inverse.transpose() +
                      pressure * derivative_of_inverse((f.transpose() * f).inverse());
}

}  // namespace

MultiplicativeResponse integrate_multiplicative(const PlasticPoint& point, const MultiplicativeState& state,
                                                const Matrix3d& before, const Matrix3d& now, double expansion) {
  const Matrix3d last = deformation_gradient(before);
  const Matrix3d f = deformation_gradient(now);
  const Matrix3d back = std::cbrt(last.determinant()) * last.inverse();
  const Matrix3d g = back * state.elastic * back.transpose();
  const Trial trial(point, f, g);

  MultiplicativeResponse response;
  response.state.p = state.p;
  response.stress = trial.stress;
  response.tangent = trial.tangent;
  double kept = 1.0;
  const auto [radius_before, slope_before] = hardening(point.curve, state.p);
  const bool yields = trial.size > radius_before;
  const bool may_flow = !std::holds_alternative<NoYield>(point.curve);
  const bool flows_on = may_flow && !yields && state.flowing && trial.size > 0.0 && before == now;
  if (yields || flows_on) {
    const double hardness = point.shear * trial.trace;
    const double dp = yields ? plastic_increment(point.curve, trial.size, hardness, state.p) : 0.0;
    const auto [radius, slope] = hardening(point.curve, state.p + dp);
    const Vector6d dp_slope = (trial.size_slope - point.shear * dp * trial.trace_slope) / (hardness + slope);
    kept = yields ? radius / trial.size : 1.0;
    const Vector6d kept_slope = slope / trial.size * dp_slope - kept / trial.size * trial.size_slope;
    response.state.p += dp;
    response.state.flowing = true;
    response.stress = kept * trial.stress;
    response.tangent = kept * trial.tangent + trial.stress * kept_slope.transpose();
  }
  add_volume(point, expansion, trial, f, response);
  const Matrix3d elastic = trial.shape * (f * g * f.transpose());
  const Matrix3d deviator = kept * (elastic - trial.trace / 3.0 * Matrix3d::Identity());
  response.state.elastic = deviator + mean_of_unit_volume(deviator) * Matrix3d::Identity();
  return response;
}

}  // namespace comma::solver
