#include "solver/materials/behaviour/von_mises.hpp"

#include <cmath>
#include <limits>
#include <tuple>
#include <variant>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// Of the stresses, what rounding leaves of an equation between them.
constexpr double stress_rounding_share = 1e-14;
constexpr int most_iterations = 200;
/// The component of tensors out of the plane.
constexpr int out_of_plane = 2;

double trace(const Vector6d& t) { return t[0] + t[1] + t[2]; }

/// Strains have shear angles, which count half.
Vector6d as_tensor(const Vector6d& strain) {
  Vector6d tensor = strain;
  tensor.tail<3>() *= 0.5;
  return tensor;
}

Vector6d deviator_of(Vector6d t) {
  t.head<3>().array() -= trace(t) / 3.0;
  return t;
}

double double_product(const Vector6d& a, const Vector6d& b) {
  return a.head<3>().dot(b.head<3>()) + 2.0 * a.tail<3>().dot(b.tail<3>());
}

/// K 1 x 1 + 2 share mu (I - 1 x 1 / 3), for strains with shear angles.
Matrix6d elastic_matrix(const PlasticModuli& now, double share) {
  const double shear = share * now.shear;
  Matrix6d d = Matrix6d::Zero();
  d.topLeftCorner<3, 3>().setConstant(now.bulk - 2.0 / 3.0 * shear);
  d.diagonal().head<3>().array() += 2.0 * shear;
  d.diagonal().tail<3>().setConstant(shear);
  return d;
}

double stiffness_ratio(double now, double before) { return before != 0.0 ? now / before : 1.0; }

/// Adds the part of the flow to an elastic matrix. `normal`: 3/2 (s - X) / (its size), with single shears.
void subtract_flow(Matrix6d& d, const PlasticModuli& now, const Vector6d& normal, double factor) {
  d -= (4.0 * now.shear * now.shear * factor) * normal * normal.transpose();
}

/// What flows goes on flowing: along `relative`, s - X, over the radius where the centre moves, over its own length
/// where it stays (17.3; the same unless moduli or the radius have changed since the last step).
void flow_on(Matrix6d& d, const PlasticPoint& now, const Vector6d& relative, double p) {
  const double size = std::sqrt(1.5 * double_product(relative, relative));
  if (!(size > 0.0)) return;
  const auto [radius, slope] = hardening(now.curve, p);
  subtract_flow(d, now, 1.5 / (now.kinematic > 0.0 ? radius : size) * relative,
                1.0 / (3.0 * now.shear + 1.5 * now.kinematic + slope));
}

/// The matrix where no stress crosses the plane.
void release_across(Matrix6d& d) {
  const Vector6d column = d.col(out_of_plane);
  d -= column * column.transpose() / column[out_of_plane];
  d.row(out_of_plane).setZero();
  d.col(out_of_plane).setZero();
}

[[noreturn]] void throw_no_return(const std::string& what) {
  throw Error("integration-failure", what, "take smaller steps, or check the hardening curve");
}

}  // namespace

/// Falling, from > 0 at 0 to < 0 at trial / hardness: Newton's method between bounds.
double plastic_increment(const HardeningCurve& curve, double trial, double hardness, double p) {
  double low = 0.0, high = trial / hardness;
  double dp = 0.0;
  const auto checked = [&](double found, double radius) {
    if (radius < -stress_rounding_share * trial)
      throw_no_return(
          fmt::format("the yield stress of a point falls below zero before the plastic strain {:.6g}", p + found));
    return found;
  };
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const auto [radius, slope] = hardening(curve, p + dp);
    const double excess = trial - hardness * dp - radius;
    if (std::abs(excess) <= stress_rounding_share * trial) return checked(dp, radius);
    (excess > 0.0 ? low : high) = dp;
    const double full = hardness + slope;
    double next = full > 0.0 && std::isfinite(full) ? dp + excess / full : high;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == dp || !(high > low)) return checked(dp, radius);
    dp = next;
  }
  throw_no_return(
      fmt::format("the plastic strain of a point cannot be found beyond {:.6g}: the hardening falls too steeply", p));
}

PlasticResponse integrate_von_mises(const PlasticModuli& before, const PlasticPoint& now, const PlasticState& state,
                                    const Vector6d& increment) {
  const Vector6d strain = as_tensor(increment);
  const Vector6d deviatoric =
      stiffness_ratio(now.shear, before.shear) * deviator_of(state.stress) + 2.0 * now.shear * deviator_of(strain);
  const double pressure = stiffness_ratio(now.bulk, before.bulk) * trace(state.stress) / 3.0 + now.bulk * trace(strain);
  const Vector6d back = stiffness_ratio(now.kinematic, before.kinematic) * state.back_stress;
  const Vector6d relative = deviatoric - back;
  const double size = std::sqrt(1.5 * double_product(relative, relative));
  const double hardness = 3.0 * now.shear + 1.5 * now.kinematic;

  PlasticResponse response;
  response.state.p = state.p;
  response.state.back_stress = back;
  response.state.stress = deviatoric;
  const bool may_flow = !std::holds_alternative<NoYield>(now.curve);
  if (!may_flow || !(size > hardening(now.curve, state.p).first * (1.0 + stress_rounding_share))) {
    response.tangent = elastic_matrix(now, 1.0);
    if (may_flow && state.flowing && size > 0.0 && increment.isZero(0.0)) {
      // Nothing moves yet: what flowed in the last step is taken to flow on.
      response.state.flowing = true;
      flow_on(response.tangent, now, relative, state.p);
    }
  } else {
    const double dp = plastic_increment(now.curve, size, hardness, state.p);
    const Vector6d normal = 1.5 / size * relative;
    response.state.p = state.p + dp;
    response.state.flowing = true;
    response.state.stress -= 2.0 * now.shear * dp * normal;
    response.state.back_stress += now.kinematic * dp * normal;
    const double slope = hardening(now.curve, state.p + dp).second;
    response.tangent = elastic_matrix(now, 1.0 - 3.0 * now.shear * dp / size);
    // What flows because moduli or the radius have changed, while the strain goes back, is not taken to flow by the
    // strain (R5.03.02; hsnv125a tells).
    if (double_product(relative, strain) >= 0.0)
      subtract_flow(response.tangent, now, normal, 1.0 / (hardness + slope) - dp / size);
  }
  response.state.stress.head<3>().array() += pressure;
  return response;
}

namespace {

/// A point in plane stress that is let flow by dp, whether that is the right amount or not. With the trial's s - X its
/// deviator is s - 3 mu q (s - X) where q = dp / (R(p + dp) + hardness dp), and the strain across leaves no stress
/// there.
class FlowInPlane {
 public:
  FlowInPlane(const PlasticModuli& before, const PlasticPoint& now, const PlasticState& state,
              const Vector6d& increment)
      : now_(now),
        state_(state),
        strain_(as_tensor(increment)),
        start_(stiffness_ratio(now.shear, before.shear) * deviator_of(state.stress)),
        back_(stiffness_ratio(now.kinematic, before.kinematic) * state.back_stress),
        pressure_(stiffness_ratio(now.bulk, before.bulk) * trace(state.stress) / 3.0) {
    let_flow(0.0);
  }

  /// What the trial is beyond the yield surface that is reached.
  double excess() const { return size_ - hardness_ * dp_ - radius_; }

  /// Secants, first from no flow and that of a body in space; the excess is tested after each. Whether they end.
  bool flows_until(double most_excess) {
    double last = 0.0, last_excess = excess();
    if (last_excess <= most_excess) return true;
    let_flow(first_guess());
    for (int iteration = 0; iteration < most_iterations && excess() != last_excess; ++iteration) {
      const double here = dp_, here_excess = excess();
      const double next = here - here_excess * (here - last) / (here_excess - last_excess);
      if (!(next >= 0.0 && std::isfinite(next))) return false;
      let_flow(next);
      if (std::abs(excess()) <= most_excess) return true;
      last = here;
      last_excess = here_excess;
    }
    return false;
  }

  PlasticResponse response() const {
    PlasticResponse response;
    const Vector6d flow = 1.5 * share_ * relative_;
    response.state.p = state_.p + dp_;
    response.state.flowing = true;
    response.state.back_stress = back_ + now_.kinematic * flow;
    response.state.stress = deviator_ - 2.0 * now_.shear * flow;
    response.state.stress.head<3>().array() += pressure_ + now_.bulk * trace(strain_);
    response.state.stress[out_of_plane] = 0.0;
    response.tangent = elastic_matrix(now_, 1.0 - 3.0 * now_.shear * share_);
    if (double_product(relative_, strain_) >= 0.0)
      subtract_flow(response.tangent, now_, 1.5 / size_ * relative_, 1.0 / (hardness_ + slope_) - share_);
    release_across(response.tangent);
    return response;
  }

 private:
  /// As Code_Aster 17.3 has it: by a power law the first secant begins as if nothing hardened.
  double first_guess() const {
    if (std::holds_alternative<PowerCurve>(now_.curve)) return excess() / hardness_;
    return plastic_increment(now_.curve, size_, hardness_, state_.p);
  }

  void let_flow(double dp) {
    dp_ = dp;
    std::tie(radius_, slope_) = hardening(now_.curve, state_.p + dp);
    share_ = dp == 0.0 ? 0.0 : dp / (radius_ + hardness_ * dp);
    const double without = stress_across(0.0);
    strain_[out_of_plane] = -without / (stress_across(1.0) - without);
    stress_across(strain_[out_of_plane]);
    size_ = std::sqrt(1.5 * double_product(relative_, relative_));
  }

  double stress_across(double strain) {
    strain_[out_of_plane] = strain;
    deviator_ = start_ + 2.0 * now_.shear * deviator_of(strain_);
    relative_ = deviator_ - back_;
    return deviator_[out_of_plane] - 3.0 * now_.shear * share_ * relative_[out_of_plane] + pressure_ +
           now_.bulk * trace(strain_);
  }

  const PlasticPoint& now_;
  const PlasticState& state_;
  Vector6d strain_;  ///< as a tensor
  Vector6d start_, back_;
  double pressure_;  ///< with which the step begins
  double hardness_ = 3.0 * now_.shear + 1.5 * now_.kinematic;
  double dp_ = 0.0, radius_ = 0.0, slope_ = 0.0, share_ = 0.0, size_ = 0.0;
  Vector6d deviator_, relative_;  ///< of the trial
};

bool ends_by_secants(const HardeningCurve& curve) {
  return std::holds_alternative<PiecewiseCurve>(curve) || std::holds_alternative<PowerCurve>(curve);
}

}  // namespace

PlasticResponse integrate_von_mises_in_plane(const PlasticModuli& before, const PlasticPoint& now,
                                             const PlasticState& state, const Vector6d& increment, double tolerance) {
  if (tolerance > 0.0 && ends_by_secants(now.curve)) {
    FlowInPlane flow(before, now, state, increment);
    if (flow.excess() > 0.0 && flow.flows_until(tolerance * hardening(now.curve, 0.0).first)) return flow.response();
  }
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  Vector6d strain = increment;
  strain[out_of_plane] = 0.0;
  PlasticResponse response = integrate_von_mises(before, now, state, strain);
  for (int iteration = 0;; ++iteration) {
    const double stress = response.state.stress[out_of_plane];
    const double scale = response.state.stress.cwiseAbs().maxCoeff() +
                         std::abs(response.tangent(out_of_plane, out_of_plane) * strain[out_of_plane]);
    if (std::abs(stress) <= stress_rounding_share * scale) break;
    if (iteration == most_iterations) {
      throw Error("integration-failure", "the strain across the plane of a point in plane stress cannot be found",
                  "take smaller steps");
    }
    // The stress rises with the strain: Newton's method between bounds.
    (stress > 0.0 ? high : low) = strain[out_of_plane];
    const double last = strain[out_of_plane];
    strain[out_of_plane] -= stress / response.tangent(out_of_plane, out_of_plane);
    if (!(strain[out_of_plane] > low && strain[out_of_plane] < high)) strain[out_of_plane] = 0.5 * (low + high);
    if (strain[out_of_plane] == last) break;
    response = integrate_von_mises(before, now, state, strain);
  }
  release_across(response.tangent);
  response.state.stress[out_of_plane] = 0.0;
  return response;
}

PlasticResponse begin_von_mises(const PlasticModuli& before, const PlasticPoint& now, const PlasticState& state,
                                const Vector6d& strain_before, const Vector6d& strain_now) {
  PlasticResponse response{state, elastic_matrix(now, 1.0)};
  response.state.stress += elastic_stress(before, strain_before) - elastic_stress(now, strain_now);
  const bool may_flow = !std::holds_alternative<NoYield>(now.curve);
  const Vector6d relative = stiffness_ratio(now.shear, before.shear) * deviator_of(state.stress) -
                            stiffness_ratio(now.kinematic, before.kinematic) * state.back_stress;
  if (may_flow && state.flowing) flow_on(response.tangent, now, relative, state.p);
  return response;
}

PlasticResponse begin_von_mises_in_plane(const PlasticModuli& before, const PlasticPoint& now,
                                         const PlasticState& state, const Vector6d& strain_before,
                                         const Vector6d& strain_now) {
  PlasticResponse response = begin_von_mises(before, now, state, strain_before, strain_now);
  response.state.stress =
      state.stress + elastic_stress_in_plane(before, strain_before) - elastic_stress_in_plane(now, strain_now);
  release_across(response.tangent);
  return response;
}

Vector6d elastic_stress(const PlasticModuli& moduli, const Vector6d& strain) {
  return elastic_matrix(moduli, 1.0) * strain;
}

Vector6d elastic_stress_in_plane(const PlasticModuli& moduli, const Vector6d& strain) {
  Matrix6d d = elastic_matrix(moduli, 1.0);
  if (d(out_of_plane, out_of_plane) == 0.0) return Vector6d::Zero();
  release_across(d);
  return d * strain;
}

}  // namespace comma::solver
