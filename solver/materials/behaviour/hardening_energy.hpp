// The work that flow takes up.
#pragma once

#include "solver/materials/behaviour/hardening.hpp"

namespace comma::solver {

/// The integral of R from 0 to p, per volume; 0 for a material that does not yield. Throws what hardening() does.
double hardening_energy(const HardeningCurve& curve, double p);

}  // namespace comma::solver
