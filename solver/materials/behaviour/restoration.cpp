#include "solver/materials/behaviour/restoration.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {

namespace {

/// Of the range of temperatures: beneath it a bound is met. The speed is infinite at the upper one, where the rounding
/// of an interpolated temperature would decide between all and nothing.
constexpr double rounding = 1e-9;

double at_least_zero(const Property& property, const MaterialPoint& at, std::string_view keyword) {
  const double value = property(at);
  if (value >= 0.0) return value;
  throw Error("invalid-material",
              fmt::format("{} is {:.6g} at the temperature {:.6g}, but must be at least 0", keyword, value,
                          at[Parameter::temperature]),
              "look at the functions of REST_ECRO");
}

}  // namespace

bool may_be_restored(Relation relation) {
  return relation == Relation::isotropic_linear || relation == Relation::isotropic_traction ||
         relation == Relation::mixed_linear;
}

Hardened restored(const HardeningRestoration& restoration, const MaterialPoint& at, double time, Hardened hardened) {
  const double temperature = at[Parameter::temperature];
  if (std::isnan(temperature))
    throw Error("missing-variable", "the restoration of hardening depends on the temperature, which is not given",
                "give it by AFFE_MATERIAU/AFFE_VARC");
  const double margin = rounding * (restoration.to - restoration.from);
  if (!(restoration.from + margin < temperature && temperature < restoration.to - margin))
    return {hardened.strain, hardened.strain};
  const double exponent = at_least_zero(restoration.speed, at, "COEF_ECRO") * (temperature - restoration.from) /
                          (restoration.to - temperature);
  const double left = at_least_zero(restoration.remainder, at, "TAU_INF") * hardened.before;
  if (hardened.strain > left) hardened.strain = left + (hardened.strain - left) / (1.0 + std::expm1(exponent) * time);
  return hardened;
}

}  // namespace comma::solver
