#include "solver/fields/data/field_parts.hpp"

#include <algorithm>
#include <cmath>

#include "solver/fields/data/field_rows.hpp"

namespace comma::solver {

std::span<const double> values_of_cell(const ElementField& field, int cell) {
  const std::size_t width = field.components.size(), first = static_cast<std::size_t>(field.starts[cell]) * width,
                    end = static_cast<std::size_t>(field.starts[cell + 1]) * width;
  return std::span(field.values).subspan(first, end - first);
}

bool has_other_than_zero(const ElementField& field, int cell) {
  return std::ranges::any_of(values_of_cell(field, cell), [](double value) { return std::abs(value) > 0.0; });
}

bool is_zero(const ElementField& field, int cell) {
  return !has_other_than_zero(field, cell) &&
         std::ranges::any_of(values_of_cell(field, cell), [](double value) { return value == 0.0; });
}

ElementField on_cells(const ElementField& field, std::span<const int> cells) {
  std::vector<bool> chosen(field.starts.size() - 1, false);
  for (const int cell : cells) chosen[static_cast<std::size_t>(cell)] = true;
  const auto width = static_cast<std::ptrdiff_t>(field.components.size());
  ElementField part{field.quantity, field.support, field.components, {0}, {}};
  for (int cell = 0; cell < static_cast<int>(chosen.size()); ++cell) {
    if (chosen[static_cast<std::size_t>(cell)]) {
      part.values.insert(part.values.end(), field.values.begin() + field.starts[cell] * width,
                         field.values.begin() + field.starts[cell + 1] * width);
    }
    part.starts.push_back(static_cast<int>(static_cast<std::ptrdiff_t>(part.values.size()) / width));
  }
  const auto has_several = [&](int cell) { return part.points(cell) > 0 && field.values_a_point(cell) > 1; };
  if (std::ranges::any_of(cells, has_several)) part.sub_points = field.sub_points;
  return part;
}

NodalField on_nodes(const NodalField& field, std::span<const int> nodes) {
  const std::size_t width = field.components.size();
  NodalField part{field.quantity, field.components, std::vector<double>(field.values.size(), absent)};
  for (const int node : nodes) {
    const auto begin = static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node) * width);
    std::copy_n(field.values.begin() + begin, width, part.values.begin() + begin);
  }
  return part;
}

Field with_components(const Field& field, std::span<const int> components) {
  const std::size_t width = components_of(field).size();
  const auto rows = static_cast<std::size_t>(FieldRows(field).total());
  Field part = field;
  components_of(part).clear();
  for (const int component : components)
    components_of(part).push_back(components_of(field)[static_cast<std::size_t>(component)]);
  auto& values = values_of(part);
  values.clear();
  for (std::size_t row = 0; row < rows; ++row) {
    for (const int component : components)
      values.push_back(values_of(field)[row * width + static_cast<std::size_t>(component)]);
  }
  return part;
}

ElementField side_by_side(const ElementField& first, const ElementField& second) {
  if (first.values.empty()) return second;
  ElementField both{first.quantity, first.support, first.components, {0}, {}};
  for (const std::string& name : second.components)
    if (both.component(name) < 0) both.components.push_back(name);
  const bool is_layered = !first.sub_points.empty() || !second.sub_points.empty();
  for (int cell = 0; cell + 1 < static_cast<int>(first.starts.size()); ++cell) {
    const ElementField& part = first.points(cell) > 0 ? first : second;
    for (int point = 0; point < part.points(cell); ++point) {
      for (const std::string& name : both.components) {
        const int column = part.component(name);
        both.values.push_back(column < 0 ? absent : part.at(cell, point, column));
      }
    }
    both.starts.push_back(both.starts.back() + part.points(cell));
    if (is_layered) both.sub_points.push_back(part.values_a_point(cell));
  }
  return both;
}

ResultStep without_fields(const ResultStep& step) {
  ResultStep bare;
  bare.order = step.order;
  bare.instant = step.instant;
  bare.parameters = step.parameters;
  return bare;
}

}  // namespace comma::solver
