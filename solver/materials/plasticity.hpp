// What lies beyond linear elasticity: hardening curves and the motion of the yield surface of metals, the energy of
// rubber.
#pragma once

#include <optional>
#include <vector>

#include "solver/functions/function.hpp"
#include "solver/materials/property.hpp"

namespace comma::solver {

/// The traction curve is bilinear: beyond `yield` (stress) it has the slope `slope` (stress over total strain), less
/// than Young's modulus.
struct LinearHardening {
  Property slope{};
  Property yield{};
};

/// Yield stresses and slopes of their own in tension and in compression, which harden apart from each other (R5.03.09).
struct AsymmetricHardening {
  LinearHardening tension;
  LinearHardening compression;
};

/// Stress over total strain in simple traction, the yield point first (R5.03.02); one curve, or one for each of some
/// rising temperatures, between which and beyond which (`left`, `right`) R(p) follows.
struct TractionHardening {
  std::vector<double> temperatures;
  std::vector<TabulatedFunction> curves;
  Extension left = Extension::excluded;
  Extension right = Extension::excluded;
};

/// R(p) = s + s (E p / (a s))^(1 / n) with the yield stress s (R5.03.02).
struct PowerHardening {
  Property yield{};
  Property factor = 1.0;    ///< a
  Property exponent = 1.0;  ///< n
};

/// R(p) = R0 + H p + R1 (1 - exp(-g1 p)) + R2 (1 - exp(-g2 p)) + K (p + p0)^m, after a plateau of Lueders' bands: R(p)
/// = R(plateau) for p below it (U4.43.01, ECRO_NL).
template <class Number>
struct NonlinearHardeningOf {
  Number initial = 0.0;  ///< R0
  Number slope = 0.0;    ///< H
  Number first = 0.0;    ///< R1
  Number first_rate = 0.0;
  Number second = 0.0;  ///< R2
  Number second_rate = 0.0;
  Number power_factor = 0.0;  ///< K
  Number power_offset = 0.0;  ///< p0
  Number power = 1.0;         ///< m
  Number plateau = 0.0;       ///< cumulated plastic strain at its end
};
using NonlinearHardening = NonlinearHardeningOf<double>;  ///< at a point

/// How annealing takes hardening away between two temperatures (U4.43.01, REST_ECRO; restoration.hpp).
struct HardeningRestoration {
  Property speed{};      ///< COEF_ECRO
  Property remainder{};  ///< TAU_INF: the share that is left in the end
  double from = 0.0;     ///< the temperature at which it begins
  double to = 0.0;       ///< that at which the speed is infinite
};

/// The energy of Signorini (see hyperelastic.hpp).
struct Hyperelasticity {
  double c10 = 0.0;
  double c01 = 0.0;
  double c20 = 0.0;
  double bulk = 0.0;
};

/// What is given of a material; a relation takes what it needs.
struct Plasticity {
  std::optional<LinearHardening> linear;
  std::optional<AsymmetricHardening> asymmetric;
  std::optional<TractionHardening> traction;
  std::optional<PowerHardening> power;
  std::optional<NonlinearHardeningOf<Property>> nonlinear;
  std::optional<Hyperelasticity> hyperelasticity;
  std::optional<HardeningRestoration> restoration;
  std::optional<Property> prager;  ///< C: the centre of the yield surface moves by C times the plastic strain
};

}  // namespace comma::solver
