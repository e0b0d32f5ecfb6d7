#include "solver/fields/data/restriction.hpp"

namespace comma::solver {

namespace {

Field part_of_field(const NodalField& field, const PartOfMesh& part) {
  NodalField result{field.quantity, field.components, {}};
  for (const int node : part.nodes)
    for (std::size_t c = 0; c < field.components.size(); ++c)
      result.values.push_back(field.at(node, static_cast<int>(c)));
  return result;
}

Field part_of_field(const ElementField& field, const PartOfMesh& part) {
  ElementField result{field.quantity, field.support, field.components, {0}, {}, {}};
  for (const int cell : part.cells) {
    result.starts.push_back(result.starts.back() + field.points(cell));
    if (!field.sub_points.empty()) result.sub_points.push_back(field.sub_points[static_cast<std::size_t>(cell)]);
    for (int point = 0; point < field.points(cell); ++point)
      for (std::size_t c = 0; c < field.components.size(); ++c)
        result.values.push_back(field.at(cell, point, static_cast<int>(c)));
  }
  return result;
}

}  // namespace

Field on_part(const Field& field, const PartOfMesh& part) {
  return std::visit([&](const auto& whole) { return part_of_field(whole, part); }, field);
}

}  // namespace comma::solver
