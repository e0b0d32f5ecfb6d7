// In which volumes the values of a field lie (POST_ELEM, VOLUMOGRAMME; U4.81.22).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// A value and the volume that it stands for (area for a thickness of 1; per radian if axisymmetric).
struct ValueVolume {
  double value = 0.0;
  double volume = 0.0;
};

/// One a Gauss point, or node with an equal share of the volume, of the continuum cells among `cells` that carry the
/// component of a field at Gauss points, at the nodes of cells or by
/// cell.
std::vector<ValueVolume> value_volumes(const Model& model, const ElementField& field, int component,
                                       std::span<const int> cells);

/// Least and greatest value; `pieces` is not empty.
std::pair<double, double> value_range(std::span<const ValueVolume> pieces);

/// The volume between each two neighbours of rising bounds; a value on a bound counts below it, one on the first bound
/// above it.
std::vector<double> volumes_between(std::span<const ValueVolume> pieces, std::span<const double> bounds);

}  // namespace comma::solver
