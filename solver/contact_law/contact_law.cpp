#include "solver/contact_law/contact_law.hpp"

#include <algorithm>

namespace comma::solver {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// What of the multiplier the law takes.
double pressure_share(const ContactLaw& law) { return law.penalised ? law.pressure_share : 1.0; }
double shear_share(const ContactLaw& law) { return law.friction_penalised ? law.shear_share : 1.0; }

/// On nodes the depth, which is the multiplier once the law holds, limits the shear of a penalty.
bool is_limited_by_depth(const ContactLaw& law) { return law.penalised && law.pointwise; }

/// The pressure that limits shear is the multiplier itself, without the augmentation (R5.03.52): the gap vanishes in
/// the mean alone where points lie between nodes, and so has Code_Aster 17.3 it with a penalty.
double limiting_pressure(const ContactLaw& law, const Vector3d& multiplier, const Vector3d& jump) {
  return std::max(0.0, is_limited_by_depth(law) ? trial_pressure(law, multiplier, jump) : multiplier[0]);
}

double limit_by_multiplier(const ContactLaw& law) { return is_limited_by_depth(law) ? law.pressure_share : 1.0; }
double limit_by_gap(const ContactLaw& law) { return is_limited_by_depth(law) ? -law.augmentation : 0.0; }

Vector2d trial_shear(const ContactLaw& law, const Vector3d& multiplier, const Vector3d& jump) {
  return shear_share(law) * multiplier.tail<2>() + law.friction_augmentation * jump.tail<2>();
}

double pressure_that_limits(const ContactLaw& law, const Vector3d& multiplier, const Vector3d& jump) {
  return law.share_pressure > 0.0 ? law.share_pressure : limiting_pressure(law, multiplier, jump);
}

struct Shear {
  Vector2d value = Vector2d::Zero();
  Matrix2d by_trial = Matrix2d::Zero();
  Vector2d by_pressure = Vector2d::Zero();
};

/// Of a shear that slides at the limit. Pointwise the multiplier, as far as it is within the limit, stands for the
/// shear that it is to be.
Matrix2d sliding_by_trial(const ContactLaw& law, double limit, const Vector2d& trial, const Vector2d& multiplier) {
  const double size = trial.norm();
  const Vector2d direction = trial / size;
  if (!law.pointwise || !(shear_share(law) > 0.0) || !(limit > 0.0))
    return limit / size * (Matrix2d::Identity() - direction * direction.transpose());
  const Vector2d share = multiplier / std::max(limit, multiplier.norm());
  const double against = std::max(0.0, -share.dot(direction));
  return limit / size * (Matrix2d::Identity() - share * direction.transpose() / (1.0 + against));
}

Shear shear_of(const ContactLaw& law, ContactStatus status, double pressure, const Vector2d& multiplier,
               const Vector2d& trial) {
  Shear shear;
  if (status == ContactStatus::sticking) {
    shear.value = trial;
    shear.by_trial.setIdentity();
  } else if (status == ContactStatus::sliding && law.friction > 0.0 && trial.norm() > 0.0) {
    const Vector2d direction = trial.normalized();
    const double limit = law.friction * pressure;
    shear.value = limit * direction;
    shear.by_trial = sliding_by_trial(law, limit, trial, multiplier);
    shear.by_pressure = law.friction * direction;
  }
  return shear;
}

/// The traction of a shear, and its derivatives.
void add_traction(const ContactLaw& law, const Shear& shear, ContactLawValue& value) {
  value.traction.tail<2>() = -shear.value;
  value.traction_by_multiplier.bottomRightCorner<2, 2>() = -shear_share(law) * shear.by_trial;
  value.traction_by_jump.bottomRightCorner<2, 2>() = -law.friction_augmentation * shear.by_trial;
  value.traction_by_multiplier.bottomLeftCorner<2, 1>() = -limit_by_multiplier(law) * shear.by_pressure;
  value.traction_by_jump.bottomLeftCorner<2, 1>() = -limit_by_gap(law) * shear.by_pressure;
}

void add_shear(const ContactLaw& law, const Shear& shear, const Vector3d& multiplier, ContactLawValue& value) {
  const double augmentation = law.friction_augmentation;
  add_traction(law, shear, value);
  value.residual.tail<2>() = (shear.value - multiplier.tail<2>()) / augmentation;
  value.residual_by_multiplier.bottomRows<2>() = -value.traction_by_multiplier.bottomRows<2>() / augmentation;
  value.residual_by_multiplier.bottomRightCorner<2, 2>() -= Matrix2d::Identity() / augmentation;
  value.residual_by_jump.bottomRows<2>() = -value.traction_by_jump.bottomRows<2>() / augmentation;
}

/// What is left of a sticking point is its slip, and along the dead direction the multiplier that is to vanish.
Vector2d left_of_sticking(const ContactLaw& law, const Vector3d& multiplier, const Vector3d& jump) {
  return live_part(law, jump).tail<2>() -
         (multiplier - live_part(law, multiplier)).tail<2>() / law.friction_augmentation;
}

/// A share where nothing presses counts as itself, and with the other sign than one that is cut down (Code_Aster 17.3):
/// at a node that other points hold closed it is what they ask for all the same.
void add_idle_share(const ContactLaw& law, const Vector3d& multiplier, ContactLawValue& value) {
  const double unit = law.friction * law.share_pressure;
  const Matrix2d live = live_directions(law);
  const Matrix2d by_multiplier = live / (unit * unit) - (Matrix2d::Identity() - live) / law.friction_augmentation;
  value.residual.tail<2>() = by_multiplier * multiplier.tail<2>();
  value.residual_by_multiplier.bottomRightCorner<2, 2>() = by_multiplier;
}

/// `unit`: the shear at the pressure of shares. Pressures that press nothing have no derivative.
void add_shear_by_shares(const ContactLaw& law, ContactStatus status, const Shear& unit, const Vector3d& multiplier,
                         const Vector3d& jump, ContactLawValue& value) {
  const double augmentation = law.friction_augmentation;
  const bool is_held = law.held_share > 0.0, any = law.weighs_any_pressure;
  const double pressure = any ? multiplier[0] : limiting_pressure(law, multiplier, jump);
  const bool presses = any ? pressure != 0.0 : pressure > 0.0;
  const double present = pressure / law.share_pressure;
  Shear shear{.value = present * unit.value,
              .by_trial = present * unit.by_trial,
              .by_pressure = presses ? Vector2d(unit.value / law.share_pressure) : Vector2d::Zero()};
  if (is_held && status == ContactStatus::sticking)
    shear = {.value = law.held_share * unit.value, .by_trial = law.held_share * unit.by_trial};
  add_traction(law, shear, value);
  if (!law.friction_penalised && law.friction > 0.0 && (status == ContactStatus::open || !presses))
    return add_idle_share(law, multiplier, value);

  // Sticking points slip by nothing: said without the shear, of any size, that it takes.
  const bool sticks = status == ContactStatus::sticking && !law.friction_penalised;
  const Vector2d left =
      sticks ? left_of_sticking(law, multiplier, jump) : Vector2d((unit.value - multiplier.tail<2>()) / augmentation);
  const bool counts_by_pressure = status != ContactStatus::open && !law.friction_penalised;
  const double weight = !counts_by_pressure ? 1.0
                        : is_held           ? law.held_share
                        : any               ? present
                                            : std::max(present, least_pressure_share);
  value.residual.tail<2>() = weight * left;
  value.residual_by_multiplier.bottomRightCorner<2, 2>() =
      weight / augmentation * (shear_share(law) * unit.by_trial - Matrix2d::Identity());
  value.residual_by_jump.bottomRightCorner<2, 2>() = weight * unit.by_trial;
  if (!counts_by_pressure || is_held || any || present <= least_pressure_share) return;
  value.residual_by_multiplier.bottomLeftCorner<2, 1>() = limit_by_multiplier(law) / law.share_pressure * left;
  value.residual_by_jump.bottomLeftCorner<2, 1>() = limit_by_gap(law) / law.share_pressure * left;
}

/// Its multiplier is the traction.
void add_linear_shear(const ContactLaw& law, const Vector3d& multiplier, const Vector3d& jump, ContactLawValue& value) {
  const Matrix2d live = live_directions(law);
  const Vector2d shear = live * (law.linear_shear->at_rest + law.linear_shear->stiffness * live * jump.tail<2>());
  const Matrix2d by_jump = live * law.linear_shear->stiffness * live;
  value.traction.tail<2>() = -shear;
  value.traction_by_jump.bottomRightCorner<2, 2>() = -by_jump;
  value.residual.tail<2>() = (shear - multiplier.tail<2>()) / law.friction_augmentation;
  value.residual_by_multiplier.bottomRightCorner<2, 2>() = -Matrix2d::Identity() / law.friction_augmentation;
  value.residual_by_jump.bottomRightCorner<2, 2>() = by_jump / law.friction_augmentation;
}

/// That of live parts: along the dead direction it neither is nor changes.
Shear live_shear(const ContactLaw& law, ContactStatus status, const Vector3d& multiplier, const Vector3d& jump) {
  const Vector3d live = live_part(law, multiplier);
  Shear shear = shear_of(law, status, pressure_that_limits(law, multiplier, jump), live.tail<2>(),
                         trial_shear(law, live, live_part(law, jump)));
  shear.by_trial *= live_directions(law);
  return shear;
}

/// With all that is to vanish along the dead direction.
ContactLawValue whole_law(const ContactLaw& law, ContactStatus status, const Vector3d& multiplier,
                          const Vector3d& jump) {
  ContactLawValue value;
  if (status != ContactStatus::open) {
    value.traction[0] = trial_pressure(law, multiplier, jump);
    value.traction_by_multiplier(0, 0) = pressure_share(law);
    value.traction_by_jump(0, 0) = -law.augmentation;
  }
  value.residual[0] = (value.traction[0] - multiplier[0]) / law.augmentation;
  value.residual_by_multiplier(0, 0) = (value.traction_by_multiplier(0, 0) - 1.0) / law.augmentation;
  value.residual_by_jump(0, 0) = value.traction_by_jump(0, 0) / law.augmentation;
  // While it is closed without penalty the residual is the gap itself: pressures of any size must not round it.
  if (status != ContactStatus::open && !law.penalised) value.residual[0] = -jump[0];
  if (law.linear_shear && status != ContactStatus::open) {
    add_linear_shear(law, multiplier, jump, value);
    return value;
  }
  const Shear shear = live_shear(law, status, multiplier, jump);
  if (law.share_pressure > 0.0) {
    add_shear_by_shares(law, status, shear, multiplier, jump, value);
    return value;
  }
  add_shear(law, shear, multiplier, value);
  if (status == ContactStatus::sticking && !law.friction_penalised)
    value.residual.tail<2>() = left_of_sticking(law, multiplier, jump);
  return value;
}

}  // namespace

ContactLawValue contact_law(const ContactLaw& law, ContactStatus status, const Vector3d& multiplier,
                            const Vector3d& jump) {
  ContactLawValue value = whole_law(law, status, multiplier, jump);
  if (status != ContactStatus::open && !law.pointwise) leave_dead_to_others(law, value);
  return value;
}

double trial_pressure(const ContactLaw& law, const Vector3d& multiplier, const Vector3d& jump) {
  return pressure_share(law) * multiplier[0] - law.augmentation * jump[0];
}

double closing_pressure(const ContactLaw& law, const Vector3d& multiplier, const Vector3d& jump) {
  if (!law.penalised || law.pointwise || law.opens_by_gap) return trial_pressure(law, multiplier, jump);
  return multiplier[0] - law.penalty() * jump[0];
}

Vector3d live_part(const ContactLaw& law, Vector3d value) {
  value.tail<2>() -= law.dead.dot(value.tail<2>()) * law.dead;
  return value;
}

Matrix2d live_directions(const ContactLaw& law) { return Matrix2d::Identity() - law.dead * law.dead.transpose(); }

ContactStatus contact_status(const ContactLaw& law, bool closed, const Vector3d& multiplier, const Vector3d& jump) {
  if (!closed && !(closing_pressure(law, multiplier, jump) > 0.0)) return ContactStatus::open;
  if (!(law.friction > 0.0)) return ContactStatus::sliding;
  return shear_beyond_limit(law, multiplier, jump) <= 0.0 ? ContactStatus::sticking : ContactStatus::sliding;
}

double shear_beyond_limit(const ContactLaw& law, const Vector3d& multiplier, const Vector3d& jump) {
  return trial_shear(law, live_part(law, multiplier), live_part(law, jump)).norm() -
         law.friction * pressure_that_limits(law, multiplier, jump);
}

}  // namespace comma::solver
