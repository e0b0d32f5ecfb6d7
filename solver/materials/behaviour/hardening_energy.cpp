#include "solver/materials/behaviour/hardening_energy.hpp"

#include <algorithm>
#include <cmath>

namespace comma::solver {

namespace {

double under_pieces(const PiecewiseCurve& curve, double p) {
  double energy = 0.0;
  double from = 0.0;
  // Straight between its corners: trapezoids are exact.
  const auto add = [&](double to) {
    energy += 0.5 * (to - from) * (hardening(curve, from).first + hardening(curve, to).first);
    from = to;
  };
  for (const auto& point : curve.points)
    if (point.first > 0.0 && point.first < p) add(point.first);
  add(p);
  return energy;
}

double under_power(const PowerCurve& curve, double p) {
  return curve.yield * p + curve.factor * std::pow(p, curve.power + 1.0) / (curve.power + 1.0);
}

/// The integral of a (1 - exp(-rate q)).
double under_exponential(double amplitude, double rate, double p) {
  return rate == 0.0 ? 0.0 : amplitude * (p + std::expm1(-rate * p) / rate);
}

double under_nonlinear(const NonlinearHardening& law, double p) {
  const double grown = law.power + 1.0;
  return law.initial * p + 0.5 * law.slope * p * p + under_exponential(law.first, law.first_rate, p) +
         under_exponential(law.second, law.second_rate, p) +
         law.power_factor * (std::pow(p + law.power_offset, grown) - std::pow(law.power_offset, grown)) / grown;
}

/// Along the plateau R is what it is at its end.
double under_plateau(const NonlinearHardening& law, double p) {
  const double flat = std::min(p, law.plateau);
  double energy = flat > 0.0 ? flat * hardening(law, law.plateau).first : 0.0;
  if (p > law.plateau) energy += under_nonlinear(law, p) - under_nonlinear(law, law.plateau);
  return energy;
}

}  // namespace

double hardening_energy(const HardeningCurve& curve, double p) {
  if (!(p > 0.0)) return 0.0;
  if (const auto* piecewise = std::get_if<PiecewiseCurve>(&curve)) return under_pieces(*piecewise, p);
  if (const auto* power = std::get_if<PowerCurve>(&curve)) return under_power(*power, p);
  if (const auto* nonlinear = std::get_if<NonlinearHardening>(&curve)) return under_plateau(*nonlinear, p);
  return 0.0;
}

}  // namespace comma::solver
