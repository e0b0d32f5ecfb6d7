// Unilateral contact and Coulomb friction at a point, in augmented form.
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Dense>

namespace comma::solver {

/// A shear that resists by `at_rest + stiffness * slip`, whatever presses.
struct LinearShear {
  Eigen::Vector2d at_rest = Eigen::Vector2d::Zero();
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();
};

/// Coefficients are pressures a unit of length.
struct ContactLaw {
  double augmentation = 100.0;  ///< of the pressure by the gap
  bool penalised = false;       ///< the pressure is penalty() times the depth
  /// Of a penalty, how much of the pressure the multiplier brings, less than one; the augmentation brings the rest.
  double pressure_share = 0.0;
  double friction = 0.0;                 ///< Coulomb's coefficient
  double friction_augmentation = 100.0;  ///< of the shear by the slip
  bool friction_penalised = false;       ///< the shear is friction_penalty() times the slip while it sticks
  double shear_share = 0.0;              ///< the same as pressure_share
  /// A unit vector along the tangents, or zero: along it there is no shear. Its multiplier vanishes, as that of a shear
  /// without friction does.
  Eigen::Vector2d dead = Eigen::Vector2d::Zero();
  /// Positive: a shear is a share of the limit of friction, in units of `friction` times this pressure: what the law
  /// gives at this pressure times the present one over it. 0: shears are themselves.
  double share_pressure = 0.0;
  /// Whether the multiplier is that of this point alone, and so the traction once the law holds.
  bool pointwise = false;
  bool opens_by_gap = false;  ///< of a penalty between nodes: where it does not overlap (see closing_pressure)
  double held_share = 0.0;  ///< positive: by shares, what stands for the present pressure over share_pressure, save in
                            ///< the limit of friction
  /// By shares: a pressure that pulls weighs them as one that pushes, and what weighs them has no derivative: that of
  /// iterations which hold closed points (Code_Aster 17.3).
  bool weighs_any_pressure = false;
  std::optional<LinearShear> linear_shear;  ///< stands for the law of friction while the point is closed

  double penalty() const { return augmentation / (1.0 - pressure_share); }
  double friction_penalty() const { return friction_augmentation / (1.0 - shear_share); }
};

/// The least share of pressure by which a share of the limit of friction counts: one that nothing presses on is still
/// one.
inline constexpr double least_pressure_share = 1e-6;

enum class ContactStatus : std::uint8_t { open, sliding, sticking };

/// At a point: the first component is along the normal, the others along two tangents.
/// `traction`: what the master does to the slave: pressure, then shear (against the slip). `residual` (a length): zero
/// in the integral sense once the law holds. Derivatives by the multiplier (pressure, then shear that resists) and by
/// the jump (gap, then slip).
struct ContactLawValue {
  Eigen::Vector3d traction = Eigen::Vector3d::Zero();
  Eigen::Vector3d residual = Eigen::Vector3d::Zero();
  Eigen::Matrix3d traction_by_multiplier = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d traction_by_jump = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d residual_by_multiplier = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d residual_by_jump = Eigen::Matrix3d::Zero();
};

/// The law of Alart and Curnier (Computer Methods in Applied Mechanics and Engineering 92, 1991; R5.03.52) with the
/// status held: closed: pressure - augmentation * gap pushes, and the gap vanishes; open: the pressure vanishes. Shear:
/// sticking, it is shear + friction_augmentation * slip, and the slip vanishes; sliding, it is cut down to friction *
/// pressure, the pressure being the multiplier without the augmentation. By shares (see share_pressure), which R5.03.52
/// takes for multipliers of friction, the residual of shears counts by the pressure. Where the law holds pointwise,
/// derivatives of shears that slide are those of Hüeber, Stadler and Wohlmuth (SIAM Journal on Scientific Computing 30,
/// 2008): exact once it holds, and farther away such that Newton's method does not overshoot.
ContactLawValue contact_law(const ContactLaw& law, ContactStatus status, const Eigen::Vector3d& multiplier,
                            const Eigen::Vector3d& jump);

/// A multiplier or a jump without what lies along the dead direction of the law.
Eigen::Vector3d live_part(const ContactLaw& law, Eigen::Vector3d value);
/// The same of two tangents, as a matrix.
Eigen::Matrix2d live_directions(const ContactLaw& law);
/// Between nodes what is left of the law along its dead direction counts next to nothing: other points of its nodes may
/// know of the multiplier there, and it vanishes where none does. Of a value with a residual and its derivatives.
template <class LawValue>
void leave_dead_to_others(const ContactLaw& law, LawValue& value) {
  constexpr double dead_weight = 1e-8;  // less than figures are compared by
  if (law.dead.isZero()) return;
  const Eigen::Matrix2d weights = live_directions(law) + dead_weight * law.dead * law.dead.transpose();
  value.residual.template tail<2>() = weights * value.residual.template tail<2>();
  for (Eigen::Matrix3d* derivative : {&value.residual_by_multiplier, &value.residual_by_jump})
    derivative->bottomRows<2>() = weights * derivative->bottomRows<2>();
}

/// The pressure that the law brings while it is closed.
double trial_pressure(const ContactLaw& law, const Eigen::Vector3d& multiplier, const Eigen::Vector3d& jump);

/// A point opens where this does not push. Of a penalty between nodes it is the interpolated multiplier less the
/// penalty times the gap, as in Code_Aster 17.3: a point on which the nodes press stays closed, and pulls, across a
/// small gap.
double closing_pressure(const ContactLaw& law, const Eigen::Vector3d& multiplier, const Eigen::Vector3d& jump);

/// The status that the law gives a point. `closed` points stay so.
ContactStatus contact_status(const ContactLaw& law, bool closed, const Eigen::Vector3d& multiplier,
                             const Eigen::Vector3d& jump);

/// By how much the shear that would stick exceeds the limit of friction.
double shear_beyond_limit(const ContactLaw& law, const Eigen::Vector3d& multiplier, const Eigen::Vector3d& jump);

}  // namespace comma::solver
