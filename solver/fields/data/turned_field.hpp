// Fields in other axes, place by place (MODI_REPERE, U4.74.01).
#pragma once

#include <functional>
#include <span>

#include <Eigen/Dense>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// The axes (rows) at a row of values: of a nodal field its node, of an element field a point, counted through all
/// cells.
using RowAxes = std::function<Eigen::Matrix3d(int row)>;

/// Of a plane body what it has no room for vanishes; turned round an axis across it, its tensors keep their one shear
/// in SIXY (with_shear_of_plane).
enum class TurnedBody : std::uint8_t { in_space, plane, plane_round_axis };

/// The field with vectors and tensors turned (in_axes) in some rows, all else as it was.
NodalField turned(const NodalField& field, std::span<const int> rows, const RowAxes& axes, TurnedBody body);
ElementField turned(const ElementField& field, std::span<const int> rows, const RowAxes& axes, TurnedBody body);

/// The rows of the values that some cells have.
std::vector<int> rows_of_cells(const ElementField& field, std::span<const int> cells);

}  // namespace comma::solver
