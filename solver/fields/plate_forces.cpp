#include "solver/fields/plate_forces.hpp"

#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/fields/field_algebra.hpp"

namespace comma::solver {

namespace {

constexpr std::array<std::array<std::string_view, 2>, 3> pairs = {{{"NXX", "MXX"}, {"NYY", "MYY"}, {"NXY", "MXY"}}};

int column_of(const ElementField& field, std::string_view name) {
  const int column = field.component(name);
  if (column < 0) throw Error("unknown-component", fmt::format("the field has no component {}, as forces of plates have", name));
  return column;
}

double offset_of(const Model& model, const ElementProperties& properties, int cell) {
  const auto found = properties.plates.find(cell);
  if (found != properties.plates.end()) return found->second.offset;
  throw Error("missing-properties", fmt::format("the plate on cell {} has no thickness", model.mesh->cell_name(cell)));
}

}  // namespace

ElementField forces_about_middle(const Model& model, const ElementProperties& properties, const ElementField& forces,
                                 std::span<const int> cells) {
  std::vector<int> plates;
  for (const int cell : cells) {
    if (is_plate(model.formulations[cell]) && !model.is_skin(cell)) plates.push_back(cell);
  }
  if (plates.empty()) throw Error("not-a-plate", "none of these cells is a plate");
  ElementField result = on_cells(forces, plates);
  const std::size_t width = result.components.size();
  for (const auto& [force_name, moment_name] : pairs) {
    const auto force = static_cast<std::size_t>(column_of(result, force_name));
    const auto moment = static_cast<std::size_t>(column_of(result, moment_name));
    for (const int cell : plates) {
      const double offset = offset_of(model, properties, cell);
      for (int point = result.starts[cell]; point < result.starts[cell + 1]; ++point) {
        double* row = result.values.data() + static_cast<std::size_t>(point) * width;
        row[moment] -= offset * row[force];
      }
    }
  }
  return result;
}

}  // namespace comma::solver
