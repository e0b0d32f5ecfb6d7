#include "solver/contact_law/smoothed_law.hpp"

#include <algorithm>
#include <cmath>

namespace comma::solver {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// a^(1 - share) b^share.
double blend(double a, double b, double share) { return share > 0.0 ? a * std::pow(b / a, share) : a; }

double count_of(double closed, double stiffness, double of_bodies) {
  return closed + (1.0 - closed) * std::min(1.0, stiffness / of_bodies);
}

}  // namespace

/// What is not negative, rounded off by e: max(0, x) where e vanishes. `beyond`: by how much it exceeds x, `flatness`:
/// one less the slope, neither of which rounding takes away however small it is; `curvature`: the derivative of the
/// slope.
struct SmoothedLaw::PositivePart {
  double value = 0.0, slope = 1.0, beyond = 0.0, flatness = 0.0, curvature = 0.0;
  static PositivePart of(double x, double e) {
    const double root = std::sqrt(x * x + 4.0 * e * e);
    const double large = 0.5 * (std::abs(x) + root), small = e * e / large;
    PositivePart part;
    part.value = x >= 0.0 ? large : small;
    part.beyond = x >= 0.0 ? small : large;
    part.slope = part.value / root;
    part.flatness = part.beyond / root;
    part.curvature = 2.0 * part.slope * part.flatness / root;
    return part;
  }
};

struct SmoothedLaw::Shear {
  Vector2d value = Vector2d::Zero(), by_limit = Vector2d::Zero();
  Matrix2d by_trial = Matrix2d::Zero(), by_trial_missing = Matrix2d::Identity();  ///< and what is missing from one
  double missing = 1.0;  ///< share of the trial that is cut off
  double sticks = 0.0;
};

SmoothedLaw::SmoothedLaw(const ContactLaw& law, PointStiffness bodies, const LawSmoothing& smoothing)
    : law_(law),
      bodies_(bodies),
      smoothing_(smoothing),
      stiffness_(law.penalised ? bodies.normal : blend(bodies.normal, law.augmentation, smoothing.law_share)),
      stiffness_along_(law.friction_penalised
                           ? bodies.along
                           : blend(bodies.along, law.friction_augmentation, smoothing.law_share_along)),
      by_multiplier_(law.penalised ? 1.0 - stiffness_ / law.augmentation : 1.0),
      by_multiplier_along_(law.friction_penalised ? 1.0 - stiffness_along_ / law.friction_augmentation : 1.0) {}

double SmoothedLaw::trial_pressure(const Vector3d& multiplier, const Vector3d& jump) const {
  return by_multiplier_ * multiplier[0] - stiffness_ * jump[0];
}

Vector2d SmoothedLaw::trial_shear(const Vector3d& multiplier, const Vector3d& jump) const {
  return by_multiplier_along_ * multiplier.tail<2>() + stiffness_along_ * jump.tail<2>();
}

SmoothedLawValue SmoothedLaw::at(const Vector3d& multiplier, const Vector3d& jump) const {
  const double trial = trial_pressure(multiplier, jump);
  // That a pressure times a gap is the square of the rounding over the stiffness does not depend on the augmentation.
  const PositivePart pressure =
      smoothing_.stays_closed ? PositivePart{.value = trial}
                              : PositivePart::of(trial, smoothing_.pressure * std::sqrt(stiffness_ / bodies_.normal));
  const double softness = law_.penalised ? 1.0 / law_.augmentation : 0.0;
  SmoothedLawValue result;
  result.traction[0] = pressure.value;
  result.traction_by_multiplier(0, 0) = by_multiplier_ * pressure.slope;
  result.traction_by_jump(0, 0) = -stiffness_ * pressure.slope;
  result.residual[0] = trial >= 0.0 ? pressure.beyond / stiffness_ - jump[0] - softness * multiplier[0]
                                    : (pressure.value - multiplier[0]) / stiffness_;
  result.residual_by_multiplier(0, 0) = -pressure.flatness / stiffness_ - softness * pressure.slope;
  result.residual_by_jump(0, 0) = -pressure.slope;
  result.counts = count_of(pressure.slope, stiffness_, bodies_.normal);
  if (smoothing_.rubs) add_shear(pressure, multiplier, jump, result);
  return result;
}

/// limit / max(|trial|, limit) of the trial, rounded off by e.
SmoothedLaw::Shear SmoothedLaw::shear_of(const Vector2d& trial, double limit, double e) {
  Shear shear;
  if (!(limit > 0.0)) return shear;
  const double size = trial.norm();
  const PositivePart beyond = PositivePart::of(size - limit, e);
  const double most = limit + beyond.value, share = limit / most;
  Matrix2d along = Matrix2d::Zero();
  if (size > 0.0) along = share / most * beyond.slope / size * trial * trial.transpose();
  shear.value = share * trial;
  shear.missing = beyond.value / most;
  shear.sticks = beyond.flatness;
  shear.by_trial = share * Matrix2d::Identity() - along;
  shear.by_trial_missing = shear.missing * Matrix2d::Identity() + along;
  shear.by_limit = (1.0 / most - limit / (most * most) * beyond.flatness) * trial;
  return shear;
}

/// That of live parts: what lies along the dead direction is cut off.
SmoothedLaw::Shear SmoothedLaw::live_shear(const Vector3d& multiplier, const Vector3d& jump, double limit) const {
  Shear shear = shear_of(trial_shear(live_part(law_, multiplier), live_part(law_, jump)), limit,
                         law_.friction * smoothing_.pressure * std::sqrt(stiffness_along_ / bodies_.along));
  const Matrix2d live = live_directions(law_);
  shear.by_trial *= live;
  shear.by_trial_missing = shear.by_trial_missing * live + law_.dead * law_.dead.transpose();
  return shear;
}

void SmoothedLaw::add_shear(const PositivePart& pressure, const Vector3d& multiplier, const Vector3d& jump,
                            SmoothedLawValue& result) const {
  const double softness = law_.friction_penalised ? 1.0 / law_.friction_augmentation : 0.0;
  const PositivePart limiting = PositivePart::of(multiplier[0], smoothing_.pressure);
  const bool by_shares = law_.share_pressure > 0.0;
  const double limit = law_.friction * (by_shares ? law_.share_pressure : limiting.value);
  const Shear shear = live_shear(multiplier, jump, limit);
  // By shares the shear is that of a pressure that is given, times the present one over it.
  const double present = by_shares ? limiting.value / law_.share_pressure : 1.0;
  const Vector2d by_pressure = by_shares ? Vector2d(limiting.slope / law_.share_pressure * shear.value)
                                         : Vector2d(law_.friction * limiting.slope * shear.by_limit);
  result.traction.tail<2>() = -present * shear.value;
  result.traction_by_multiplier.bottomRightCorner<2, 2>() = -present * by_multiplier_along_ * shear.by_trial;
  result.traction_by_multiplier.bottomLeftCorner<2, 1>() = -by_pressure;
  result.traction_by_jump.bottomRightCorner<2, 2>() = -present * stiffness_along_ * shear.by_trial;
  result.counts_along = count_of(shear.sticks, stiffness_along_, bodies_.along);

  const double weight = law_.friction_penalised ? 1.0 : present;
  const Vector2d resists = live_part(law_, multiplier).tail<2>(), slip = live_part(law_, jump).tail<2>();
  const Vector2d left = (1.0 - shear.missing) * (slip - softness * resists) -
                        (shear.missing * resists + multiplier.tail<2>() - resists) / stiffness_along_;
  result.residual.tail<2>() = weight * left;
  result.residual_by_multiplier.bottomRightCorner<2, 2>() =
      -weight * (shear.by_trial_missing / stiffness_along_ + softness * shear.by_trial);
  result.residual_by_jump.bottomRightCorner<2, 2>() = weight * shear.by_trial;
  if (!by_shares)
    result.residual_by_multiplier.bottomLeftCorner<2, 1>() = by_pressure / stiffness_along_;
  else if (!law_.friction_penalised)
    result.residual_by_multiplier.bottomLeftCorner<2, 1>() = limiting.slope / law_.share_pressure * left;
  if (smoothing_.on_node) return;
  leave_dead_to_others(law_, result);
  let_open_shears_vanish(pressure, multiplier, result);
}

/// Between nodes a point may be open where the pressure of its nodes is not zero: it bears no shear all the same.
void SmoothedLaw::let_open_shears_vanish(const PositivePart& pressure, const Vector3d& multiplier,
                                         SmoothedLawValue& result) const {
  const Vector2d vanishing = -multiplier.tail<2>() / stiffness_along_;
  const Vector2d residual_by_trial = pressure.curvature * (result.residual.tail<2>() - vanishing),
                 traction_by_trial = pressure.curvature * result.traction.tail<2>();
  result.traction.tail<2>() *= pressure.slope;
  result.residual.tail<2>() = pressure.slope * result.residual.tail<2>() + pressure.flatness * vanishing;
  for (Eigen::Matrix3d* derivative : {&result.traction_by_multiplier, &result.traction_by_jump,
                                      &result.residual_by_multiplier, &result.residual_by_jump})
    derivative->bottomRows<2>() *= pressure.slope;
  result.residual_by_multiplier.bottomRightCorner<2, 2>() -=
      pressure.flatness / stiffness_along_ * Matrix2d::Identity();
  result.traction_by_multiplier.bottomLeftCorner<2, 1>() += by_multiplier_ * traction_by_trial;
  result.traction_by_jump.bottomLeftCorner<2, 1>() -= stiffness_ * traction_by_trial;
  result.residual_by_multiplier.bottomLeftCorner<2, 1>() += by_multiplier_ * residual_by_trial;
  result.residual_by_jump.bottomLeftCorner<2, 1>() -= stiffness_ * residual_by_trial;
}

ContactStatus SmoothedLaw::status(const Vector3d& multiplier, const Vector3d& jump) const {
  if (!smoothing_.stays_closed && trial_pressure(multiplier, jump) <= 0.0) return ContactStatus::open;
  const double pressure = law_.share_pressure > 0.0 ? law_.share_pressure : multiplier[0];
  const bool sticks =
      smoothing_.rubs && law_.friction > 0.0 &&
      trial_shear(live_part(law_, multiplier), live_part(law_, jump)).norm() <= law_.friction * pressure;
  return sticks ? ContactStatus::sticking : ContactStatus::sliding;
}

}  // namespace comma::solver
