#include "solver/nonlinear/contact/contact_augmentations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace comma::solver {
namespace {

/// An augmentation between nodes of this share of the stiffness of the bodies changes the solution by less than figures
/// are compared by (2e-8 in a block that opens), and pressures keep enough digits in it.
constexpr double least_augmentation = 1e-10;
/// By this it is lowered at a time.
constexpr double softer_augmentation = 1e-2;

}  // namespace

void ContactAugmentations::apply() {
  auto& points = contact_.problem.points;
  const std::vector<char> shared = shared_multipliers(contact_.problem);
  // Of points that share multipliers: one a zone, in which points weigh by it.
  std::vector<double> least(contact_.definition.zones.size(), std::numeric_limits<double>::infinity());
  const auto is_shared = [&](const CondensedPoint& point) {
    return shared[static_cast<std::size_t>(point.nodes[0])] != 0;
  };
  const auto zone = [this](std::size_t p) { return static_cast<std::size_t>(contact_.points()[p].zone); };
  for (std::size_t p = 0; p < points.size(); ++p) {
    CondensedPoint& point = points[p];
    if (point.rows == 0 || point.node_count == 0) continue;
    if (is_shared(point)) {
      least[zone(p)] = std::min(least[zone(p)], between_nodes(p));
    } else if (contact_.points()[p].node >= 0) {
      point.stiffness = at_node(p);
      if (!point.law.penalised) point.law.augmentation = point.stiffness;
      if (!point.law.friction_penalised) point.law.friction_augmentation = point.stiffness;
    }
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    CondensedPoint& point = points[p];
    if (point.rows == 0 || point.node_count == 0 || !is_shared(point)) continue;
    const double present = std::max(given(contact_.mixed_zone_of(p)), least_augmentation * least[zone(p)]);
    if (!point.law.penalised) point.law.augmentation = present;
    if (!point.law.friction_penalised) point.law.friction_augmentation = present;
  }
}

double ContactAugmentations::given(const MixedZone& zone) const {
  return zone.keeps_augmentation ? zone.augmentation : share_ * zone.augmentation;
}

bool ContactAugmentations::lower() {
  if (contact_.problem.components == 1) return false;
  const auto all = [this] {
    std::vector<double> values;
    for (const CondensedPoint& point : contact_.problem.points) values.push_back(point.law.augmentation);
    return values;
  };
  const std::vector<double> before = all();
  share_ *= softer_augmentation;
  apply();
  return all() != before;
}

double ContactAugmentations::between_nodes(std::size_t p) const {
  const CondensedPoint& point = contact_.problem.points[p];
  const Eigen::VectorXd& sizes = tangent_.row_sizes();
  double compliance = 0.0;
  for (RowMatrix::InnerIterator it(contact_.rows.reduced(), point.first_row); it; ++it)
    if (sizes[it.col()] > 0.0) compliance += it.value() * it.value() / sizes[it.col()];
  return compliance > 0.0 ? 1.0 / (compliance * std::abs(point.weight)) : 0.0;
}

double ContactAugmentations::at_node(std::size_t p) const {
  const CondensedPoint& point = contact_.problem.points[p];
  const Eigen::VectorXd& sizes = tangent_.row_sizes();
  double stiffness = 0.0;
  for (RowMatrix::InnerIterator it(contact_.rows.reduced(), point.first_row); it; ++it)
    stiffness = std::max(stiffness, std::abs(it.value()) * sizes[it.col()]);
  return stiffness / std::abs(point.weight);
}

}  // namespace comma::solver
