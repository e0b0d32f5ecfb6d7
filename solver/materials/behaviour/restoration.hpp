// Restoration of hardening: how annealing takes it away at the end of each step (POST_INCR='REST_ECRO', U4.51.11).
#pragma once

#include "solver/materials/plasticity.hpp"
#include "solver/materials/property.hpp"
#include "solver/model/behaviour.hpp"

namespace comma::solver {

/// Whether annealing can take the hardening of a law away: VMIS_ISOT_LINE, VMIS_ISOT_TRAC, VMIS_ECMI_LINE. What hardens
/// otherwise has no single strain that could be taken away.
bool may_be_restored(Relation relation);

/// The cumulated plastic strain by which a point has hardened.
struct Hardened {
  double strain = 0.0;
  double before = 0.0;  ///< what it was when annealing began
};

/// What is left after a step of length `time` at whose end the point is `at`. With the temperature T between its
/// bounds the strain p goes to tau p0, p0 being that before, by the implicit step of
///     dp/dt = -(exp(a (T - from) / (to - T)) - 1) (p - tau p0)
/// with the speed a and the remainder tau; a strain below tau p0 stays. At the bounds and beyond nothing is restored,
/// and p0 becomes p. Throws Error `missing-variable` without a temperature, `invalid-material` for a speed or a
/// remainder below zero.
Hardened restored(const HardeningRestoration& restoration, const MaterialPoint& at, double time, Hardened hardened);

}  // namespace comma::solver
