#include "solver/fields/data/turned_field.hpp"

#include <algorithm>

#include "solver/fields/data/rotation.hpp"

namespace comma::solver {

namespace {

/// What a plane body has no room for vanishes when its axes turn within the plane.
bool has_room(const NodalField& field, const std::string& name, TurnedBody body) {
  return body != TurnedBody::plane || field.component(name) >= 0;
}

}  // namespace

NodalField turned(const NodalField& field, std::span<const int> rows, const RowAxes& axes, TurnedBody body) {
  NodalField own = in_axes(field, rows, axes);
  if (body == TurnedBody::plane_round_axis) own = with_shear_of_plane(own);
  NodalField result{field.quantity, {}, {}};
  std::vector<int> kept;
  for (std::size_t c = 0; c < own.components.size(); ++c) {
    if (!has_room(field, own.components[c], body)) continue;
    kept.push_back(static_cast<int>(c));
    result.components.push_back(own.components[c]);
  }
  const std::size_t count = field.values.size() / std::max<std::size_t>(field.components.size(), 1);
  std::vector<char> is_turned(count, 0);
  for (const int row : rows) is_turned[static_cast<std::size_t>(row)] = 1;
  for (std::size_t row = 0; row < count; ++row) {
    for (const int c : kept) {
      const int before = field.component(own.components[static_cast<std::size_t>(c)]);
      const double unturned = before < 0 ? absent : field.at(static_cast<int>(row), before);
      result.values.push_back(is_turned[row] != 0 ? own.at(static_cast<int>(row), c) : unturned);
    }
  }
  return result;
}

ElementField turned(const ElementField& field, std::span<const int> rows, const RowAxes& axes, TurnedBody body) {
  NodalField made = turned(NodalField{field.quantity, field.components, field.values}, rows, axes, body);
  ElementField result = field;
  result.components = std::move(made.components);
  result.values = std::move(made.values);
  return result;
}

std::vector<int> rows_of_cells(const ElementField& field, std::span<const int> cells) {
  std::vector<int> rows;
  for (const int cell : cells)
    for (int row = field.starts[cell]; row < field.starts[cell + 1]; ++row) rows.push_back(row);
  return rows;
}

}  // namespace comma::solver
