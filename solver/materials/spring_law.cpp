#include "solver/materials/spring_law.hpp"

#include <cmath>
#include <utility>

namespace comma::solver {

namespace {

/// The centre of the elastic domain and how it changes with the plastic displacement.
std::pair<double, double> centre(const HardeningSpring& law, double plastic) {
  const double straight = law.slope * plastic;
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

/// |F - X(a)| = yield with F = k (u - a): what is left of it falls as a moves on, the less the further, so that
/// Newton's method does not pass the root but from its side, and an interval that holds the root catches it.
SpringResponse hardening_response(const HardeningSpring& law, double stiffness, double displacement, double plastic) {
  const double trial = stiffness * (displacement - plastic);
  const double apart = trial - centre(law, plastic).first;
  if (std::abs(apart) <= law.yield) return {trial, stiffness, plastic};
  const double sense = std::copysign(1.0, apart);
  double low = 0.0, high = (std::abs(apart) - law.yield) / stiffness;  // of the plastic increment in that sense
  double increment = high * stiffness / (stiffness + centre(law, plastic).second);
  constexpr int most_iterations = 200;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const double now = plastic + sense * increment;
    const auto [place, change] = centre(law, now);
    const double left = sense * (stiffness * (displacement - now) - place) - law.yield;
    (left > 0.0 ? low : high) = increment;
    double next = increment + left / (stiffness + change);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == increment || next == low || next == high) break;
    increment = next;
  }
  const double reached = plastic + sense * increment;
  const double change = centre(law, reached).second;
  return {stiffness * (displacement - reached), stiffness * change / (stiffness + change), reached};
}

}  // namespace comma::solver
