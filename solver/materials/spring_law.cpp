#include "solver/materials/spring_law.hpp"

#include <cmath>
#include <utility>

namespace comma::solver {

namespace {

/// The centre of the elastic domain and how it changes with the displacement that moves it.
std::pair<double, double> centre(const HardeningSpring& law, double flowed) {
  const double straight = law.slope * flowed;
  if (law.power == 0.0) return {straight, law.slope};
  const double bent = 1.0 + std::pow(std::abs(straight) / law.limit, law.power);
  const double root = std::pow(bent, -1.0 / law.power);
  return {straight * root, law.slope * root / bent};
}

}  // namespace

SpringResponse bilinear_response(double first, double last, double bound, double displacement) {
  const double bend = bound / first;
  if (std::abs(displacement) <= bend) return {first * displacement, first};
  return {std::copysign(bound + last * (std::abs(displacement) - bend), displacement), last};
}

SpringResponse hardening_response(const HardeningSpring& law, double stiffness, double displacement,
                                  const SpringPast& past) {
  const double trial = stiffness * (displacement - past.plastic);
  const double begun = centre(law, past.flowed).first;
  const double apart = trial - begun;
  if (std::abs(apart) <= law.yield) return {trial, stiffness, past};
  const double bound = std::copysign(law.yield, apart);
  SpringPast reached = past;
  reached.flowed += (apart - bound) / stiffness;
  const auto [place, change] = centre(law, reached.flowed);
  const double force = place + bound;
  reached.plastic = displacement - force / stiffness;
  reached.spent += 0.5 * (reached.plastic - past.plastic) * (begun + bound + force);
  return {force, change, reached};
}

double flowed_for_centre(const HardeningSpring& law, double place) {
  if (law.slope == 0.0) return 0.0;
  if (law.power == 0.0) return place / law.slope;
  const double rest = 1.0 - std::pow(std::abs(place) / law.limit, law.power);
  return rest > 0.0 ? place / law.slope * std::pow(rest, -1.0 / law.power) : 0.0;
}

}  // namespace comma::solver
