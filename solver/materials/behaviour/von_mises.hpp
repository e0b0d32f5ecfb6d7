// Von Mises plasticity with isotropic and linear kinematic hardening, integrated implicitly by radial return (R5.03.02,
// R5.03.16; Simo and Hughes, Computational Inelasticity, chapter 3).
//
// Stresses are (xx, yy, zz, xy, xz, yz), strains alike with shear angles.
#pragma once

#include "solver/materials/behaviour/hardening.hpp"

namespace comma::solver {

/// What a point remembers. The back stress X = C (plastic strain) is the centre of the yield surface.
struct PlasticState {
  Vector6d stress = Vector6d::Zero();
  Vector6d back_stress = Vector6d::Zero();
  double p = 0.0;        ///< cumulated plastic strain
  bool flowing = false;  ///< whether the last step was plastic
};

struct PlasticResponse {
  PlasticState state;
  /// d stress / d strain: consistent with the integration, of the flow itself where the strain does not change. Where
  /// moduli that have changed make it flow while the strain goes back, without the flow.
  Matrix6d tangent;
};

/// dp >= 0 with trial - hardness dp - R(p + dp) = 0, for trial > R(p). Throws Error `integration-failure` for softening
/// steeper than the elasticity bears, and where R is below zero at such a dp: no stress is left to return to.
double plastic_increment(const HardeningCurve& curve, double trial, double hardness, double p);

/// The stress after a strain increment (less that of the command variables), from the state before and its constants
/// `before`, by those of now: yield where sqrt(3/2) |s - X| > R(p), then
///
///     sqrt(3/2) |s_trial - X| - (3 mu + 3/2 C) dp - R(p + dp) = 0.
///
/// Elastic strains and plastic strains are kept when the constants change. Throws what plastic_increment() does.
PlasticResponse integrate_von_mises(const PlasticModuli& before, const PlasticPoint& now, const PlasticState& state,
                                    const Vector6d& increment);

/// Where a step begins and nothing has moved but the strain of the command variables, from `strain_before` to
/// `strain_now`: the stress changes by what these would hold up in the elastic material, each by its own moduli, and
/// what flowed in the last step flows on along the normal that it has. So Code_Aster predicts a step (hsnv125b tells).
PlasticResponse begin_von_mises(const PlasticModuli& before, const PlasticPoint& now, const PlasticState& state,
                                const Vector6d& strain_before, const Vector6d& strain_now);
/// The same without stress across the plane.
PlasticResponse begin_von_mises_in_plane(const PlasticModuli& before, const PlasticPoint& now,
                                         const PlasticState& state, const Vector6d& strain_before,
                                         const Vector6d& strain_now);

/// Hooke's law.
Vector6d elastic_stress(const PlasticModuli& moduli, const Vector6d& strain);
/// The same without stress across the plane, whatever the strain there.
Vector6d elastic_stress_in_plane(const PlasticModuli& moduli, const Vector6d& strain);

/// integrate_von_mises() without stress across the plane: the strain zz is an unknown (the row and column of zz of the
/// tangent are zero). With a `tolerance` (of the first yield stress) what flows is found as Code_Aster 17.3 finds it,
/// by secants that end there (RESI_INTE), but with saturating exponentials; without, as exactly as rounding lets it.
PlasticResponse integrate_von_mises_in_plane(const PlasticModuli& before, const PlasticPoint& now,
                                             const PlasticState& state, const Vector6d& increment,
                                             double tolerance = 0.0);

}  // namespace comma::solver
