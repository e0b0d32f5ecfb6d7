#include "solver/contact_law/raised_penalties.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

/// One of friction is raised by as much as points slip too far, which suffices where the shear stays: a little more,
/// and at least twice, so that a few rounds do.
double growth_with(double excess) {
  constexpr double margin = 1.1, least = 2.0;
  return std::max(least, margin * excess);
}

/// One of contact is doubled, and once more until points are no longer too deep (Code_Aster 17.3).
double doubling(double) { return 2.0; }

struct Wording {
  const char* penalty;
  const char* what;
  const char* hint;
};

/// `most`: the largest factor of each zone.
bool raise_factors(std::vector<double>& factors, const std::vector<double>& excess, double (*growth)(double),
                   const std::vector<double>& most, const Wording& wording) {
  bool raised = false;
  for (std::size_t zone = 0; zone < excess.size(); ++zone) {
    if (excess[zone] <= 1.0) continue;
    factors[zone] *= growth(excess[zone]);
    if (factors[zone] > most[zone])
      throw Error("no-convergence",
                  fmt::format("a {} {:.2g} times the one given does not keep {} than allowed", wording.penalty,
                              most[zone], wording.what),
                  wording.hint);
    raised = true;
  }
  return raised;
}

}  // namespace

void RaisedPenalties::limit_depth(double depth, double most) {
  depth_limit_ = depth;
  most_ = most;
}

bool RaisedPenalties::raise(const Excess& excess) {
  const auto most = [this](std::vector<double> softness) {
    for (double& each : softness) each = most_.value_or(most_beside_bodies * each);
    return softness;
  };
  const bool pressed = raise_factors(
      contact_, excess.depth, doubling, most(excess.soft_contact),
      {"contact penalty", "points from going deeper", "allow more depth (PENE_MAXI), or take ALGO_CONT='STANDARD'"});
  const bool rubbed = raise_factors(friction_, excess.slip, growth_with, most(excess.soft_friction),
                                    {"penalty of friction", "points that stick from slipping more",
                                     "allow more slip (GLIS_MAXI), or take ALGO_FROT='STANDARD'"});
  return pressed || rubbed;
}

bool RaisedPenalties::are_raised() const {
  const auto is_raised = [](double factor) { return factor > 1.0; };
  return std::ranges::any_of(contact_, is_raised) || std::ranges::any_of(friction_, is_raised);
}

void RaisedPenalties::go_on_from(const RaisedPenalties& others, std::size_t other, std::size_t zone) {
  contact_[zone] = others.contact_[other];
  friction_[zone] = others.friction_[other];
}

void RaisedPenalties::apply(const MixedZone& zone, int number, CondensedPoint& point) const {
  if (zone.penalised) point.law.augmentation = contact_penalty(zone, number);
  if (!zone.friction_penalised) return;
  const double penalty = friction_penalty(zone, number);
  point.law.friction_augmentation = penalty;
  if (point.share_augmentation > 0.0) point.share_augmentation = penalty;
}

}  // namespace comma::solver
