#include "solver/elements/block_fields.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "solver/error.hpp"
#include "solver/fields/data/field_parts.hpp"

namespace comma::solver {
namespace {

[[noreturn]] void throw_other_points(const ElementField& field, int cell, const Mesh& mesh, int points) {
  throw Error("incompatible-field",
              fmt::format("the field {} has {} values on cell {}, where the element has {}", field.quantity,
                          field.points(cell), mesh.cell_name(cell), points),
              "take a field of a result of the same elements there (CREA_CHAMP, OPERATION='EXTR', then 'ASSE')");
}

/// The way back: what a field has on one cell.
void read_cell(int cell, const ElementBlock& block, const std::vector<std::string>& names, const ElementField& field,
               const Mesh& mesh, std::vector<double>& values) {
  if (field.points(cell) != block.point_count()) throw_other_points(field, cell, mesh, block.point_count());
  for (int point = 0; point < block.point_count(); ++point) {
    for (const auto& name : names) {
      const int column = field.component(name);
      const double value = column < 0 ? absent : field.at(cell, point, column);
      if (std::isnan(value))
        throw Error("incompatible-field",
                    fmt::format("the field {} has no {} on cell {}", field.quantity, name, mesh.cell_name(cell)),
                    field.quantity == "SIEF_R" ? "PROL_ZERO='OUI' of CREA_CHAMP makes zero what is not named" : "");
      values.push_back(value);
    }
  }
}

}  // namespace

std::vector<std::string> variable_names(int count) {
  std::vector<std::string> names;
  for (int k = 1; k <= count; ++k) names.push_back(fmt::format("V{}", k));
  return names;
}

std::vector<std::string> stress_names(const ElementBlock& block) {
  return {block.stress_names().begin(), block.stress_names().end()};
}

std::vector<int> starts_of(const std::vector<int>& counts) {
  std::vector<int> starts(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
  return starts;
}

void write_block(const ElementBlock& block, const std::vector<std::string>& names, const std::vector<double>& values,
                 ElementField& field) {
  std::vector<int> columns;
  for (const auto& name : names) columns.push_back(field.component(name));
  const double* value = values.data();
  for (const int cell : block.cells()) {
    for (int point = field.starts[cell]; point < field.starts[cell + 1]; ++point) {
      double* target = field.values.data() + static_cast<std::size_t>(point) * field.components.size();
      for (const int column : columns) target[column] = *value++;
    }
  }
}

std::vector<double> read_block(const ElementBlock& block, const std::vector<std::string>& names,
                               const ElementField* field, const Mesh& mesh) {
  if (field == nullptr) return {};
  std::vector<double> values;
  values.reserve(block.cells().size() * static_cast<std::size_t>(block.point_count()) * names.size());
  for (const int cell : block.cells()) read_cell(cell, block, names, *field, mesh, values);
  return values;
}

std::vector<double> read_stresses(const ElementBlock& block, const ElementField* field, const Mesh& mesh) {
  if (field == nullptr) return {};
  const std::vector<std::string> names = stress_names(block);
  const std::size_t each = static_cast<std::size_t>(block.point_count()) * names.size();
  std::vector<double> values;
  values.reserve(block.cells().size() * each);
  for (const int cell : block.cells()) {
    if (is_zero(*field, cell))
      values.insert(values.end(), each, 0.0);
    else
      read_cell(cell, block, names, *field, mesh, values);
  }
  return values;
}

std::vector<double> values_on(std::span<const int> cells, const ElementField& layout, const ElementField& field,
                              const Mesh& mesh) {
  std::vector<double> values;
  for (const int cell : cells) {
    if (is_zero(field, cell)) {
      values.insert(values.end(), static_cast<std::size_t>(layout.points(cell)) * layout.components.size(), 0.0);
      continue;
    }
    if (field.points(cell) != layout.points(cell)) throw_other_points(field, cell, mesh, layout.points(cell));
    for (int point = 0; point < field.points(cell); ++point)
      for (const auto& name : layout.components) {
        const int column = field.component(name);
        values.push_back(column < 0 ? absent : field.at(cell, point, column));
      }
  }
  return values;
}

std::vector<double> read_initial_stresses(const ElementBlock& block, const ElementField& field, const Mesh& mesh) {
  std::vector<int> columns;
  for (const auto& name : stress_names(block)) columns.push_back(field.component(name));
  std::vector<double> values;
  for (const int cell : block.cells()) {
    if (block.point_count() == 0) continue;  // plates
    const int points = is_zero(field, cell) ? 0 : field.points(cell);
    if (points != 0 && points != block.point_count()) throw_other_points(field, cell, mesh, block.point_count());
    const std::size_t first = values.size();
    for (int point = 0; point < block.point_count(); ++point)
      for (const int column : columns)
        values.push_back(points == 0 || column < 0 ? absent : field.at(cell, point, column));
    const std::span own(values.begin() + static_cast<std::ptrdiff_t>(first), values.end());
    const auto is_absent = [](double value) { return std::isnan(value); };
    if (!std::ranges::all_of(own, is_absent)) std::ranges::replace_if(own, is_absent, 0.0);
  }
  return values;
}

}  // namespace comma::solver
