#include "solver/fields/integrals/volume_distribution.hpp"

#include <algorithm>
#include <cmath>

#include "solver/fields/points/continuum_points.hpp"

namespace comma::solver {

std::vector<ValueVolume> value_volumes(const Model& model, const ElementField& field, int component,
                                       std::span<const int> cells) {
  ContinuumPoints points(model);
  std::vector<ValueVolume> pieces;
  for (const int cell : cells) {
    if (!points.covers(cell) || field.points(cell) == 0) continue;
    const auto& samples = points.samples(cell);
    // At the nodes of a cell each value stands for an equal share of its volume.
    if (field.support == Support::element_node) {
      double volume = 0.0;
      for (const auto& sample : samples) volume += points.locate(cell, sample).weight;
      for (int node = 0; node < field.points(cell); ++node) {
        const double value = field.at(cell, node, component);
        if (!std::isnan(value)) pieces.push_back({value, volume / field.points(cell)});
      }
      continue;
    }
    for (std::size_t g = 0; g < samples.size(); ++g) {
      const double value = field.at(cell, field.support == Support::cell ? 0 : static_cast<int>(g), component);
      if (!std::isnan(value)) pieces.push_back({value, points.locate(cell, samples[g]).weight});
    }
  }
  return pieces;
}

std::pair<double, double> value_range(std::span<const ValueVolume> pieces) {
  const auto [least, greatest] = std::ranges::minmax_element(pieces, {}, &ValueVolume::value);
  return {least->value, greatest->value};
}

std::vector<double> volumes_between(std::span<const ValueVolume> pieces, std::span<const double> bounds) {
  std::vector<double> volumes(bounds.size() - 1, 0.0);
  for (const ValueVolume& piece : pieces) {
    if (piece.value < bounds.front() || piece.value > bounds.back()) continue;
    const auto above = std::ranges::lower_bound(bounds.subspan(1), piece.value) - (bounds.begin() + 1);
    volumes[static_cast<std::size_t>(above)] += piece.volume;
  }
  return volumes;
}

}  // namespace comma::solver
