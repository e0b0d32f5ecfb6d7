#include "solver/contact_law/adapted_penalties.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/mesh/cell_type.hpp"

namespace comma::solver {
namespace {

/// Of facets that are all of one size, a pressure over a length in the units of the file (Code_Aster 17.3).
constexpr double least_penalty = 1e5;
/// PENE_MAXI where none is given, as a share of the smallest facet.
constexpr double usual_depth = 1e-2;
/// A penalty beyond the stiffness of the bodies is divided by it.
constexpr double softening = 100.0;
/// Penalties that change by a smaller share are settled.
constexpr double settled_change = 1e-8;

}  // namespace

double penalty_growth(double depth, double before, double allowed) {
  const double excess = depth / allowed;
  if (std::abs(depth - before) > std::max(0.1 * depth, 5.0 * allowed)) return std::max(2.0, excess);
  const double root = std::sqrt(excess - 1.0) + 1.0;
  return excess <= 10.0 ? root * root : excess;
}

double facet_size(const Mesh& mesh, int facet) {
  const std::span<const int> nodes = mesh.cell(facet);
  const auto at = [&](std::size_t corner) {
    return Eigen::Map<const Eigen::Vector3d>(mesh.nodes[static_cast<std::size_t>(nodes[corner])].data());
  };
  switch (corner_count(mesh.cell_types[static_cast<std::size_t>(facet)])) {
    case 2:
      return (at(1) - at(0)).norm();
    case 3:
      return (at(2) - 0.5 * (at(0) + at(1))).norm();
    default:
      return (at(2) - at(0)).norm() + (at(3) - at(1)).norm();
  }
}

void AdaptedPenalties::face(const ContactDefinition& definition, std::span<const ContactPoint> points,
                            const Mesh& mesh) {
  struct Sizes {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0.0;
  };
  std::vector<Sizes> sizes(definition.zones.size());
  zone_of_.resize(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    zone_of_[p] = points[p].zone;
    const auto zone = static_cast<std::size_t>(points[p].zone);
    if (!definition.zones[zone].mixed.adapts_penalty || points[p].facet < 0) continue;
    const double size = facet_size(mesh, points[p].facet);
    sizes[zone].smallest = std::min(sizes[zone].smallest, size);
    sizes[zone].largest = std::max(sizes[zone].largest, size);
  }
  zones_.resize(sizes.size());
  for (std::size_t zone = 0; zone < sizes.size(); ++zone) {
    const bool faces = sizes[zone].largest > 0.0;
    zones_[zone].least = faces ? least_penalty * sizes[zone].largest / sizes[zone].smallest : least_penalty;
    const double usual = faces ? usual_depth * sizes[zone].smallest : std::numeric_limits<double>::infinity();
    zones_[zone].allowed = definition.zones[zone].mixed.largest_depth.value_or(usual);
  }
  if (before_.size() != points.size()) before_.assign(points.size(), std::numeric_limits<double>::infinity());
  if (adaptations_ == 0 || penalties_.size() != points.size()) begin_with_least();
}

void AdaptedPenalties::begin_with_least() {
  penalties_.clear();
  for (const int zone : zone_of_) penalties_.push_back(zones_[static_cast<std::size_t>(zone)].least);
}

void AdaptedPenalties::start_step(bool closed) {
  begin_with_least();
  adaptations_ = 0;
  kept_least_ = closed && !is_first_step_ ? 2 : 1;
  is_first_step_ = false;
}

void AdaptedPenalties::note_depths(std::vector<double> depths) {
  if (adaptations_ == 0 && !began_adapted()) before_ = std::move(depths);
}

bool AdaptedPenalties::is_too_deep(std::span<const char> adapts, std::span<const double> depths) const {
  for (std::size_t p = 0; p < depths.size(); ++p) {
    const auto zone = static_cast<std::size_t>(zone_of_[p]);
    if (adapts[zone] != 0 && depths[p] > zones_[zone].allowed) return true;
  }
  return false;
}

bool AdaptedPenalties::adapt(std::span<const char> adapts, std::span<const double> depths, double stiffest,
                             bool keeps_least) {
  keeps_least = keeps_least || adaptations_ < kept_least_;
  ++adaptations_;
  bool changed = false;
  for (std::size_t p = 0; p < penalties_.size(); ++p) {
    const Zone& zone = zones_[static_cast<std::size_t>(zone_of_[p])];
    const double before = std::exchange(before_[p], depths[p]);
    if (adapts[static_cast<std::size_t>(zone_of_[p])] == 0 || depths[p] <= zone.allowed) continue;
    double wanted = penalties_[p] * penalty_growth(depths[p], before, zone.allowed);
    if (wanted > stiffest) wanted /= softening;
    if (keeps_least) wanted = std::max(wanted, zone.least);
    changed = changed || std::abs(wanted - penalties_[p]) > settled_change * penalties_[p];
    penalties_[p] = wanted;
  }
  return changed;
}

}  // namespace comma::solver
