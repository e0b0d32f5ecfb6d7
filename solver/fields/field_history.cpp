#include "solver/fields/field_history.hpp"

#include <array>
#include <cmath>

#include "solver/error.hpp"
#include "solver/fields/data/field_algebra.hpp"
#include "solver/fields/data/field_rows.hpp"

namespace comma::solver {

namespace {

void check_alike(const Field& first, const Field& other) {
  const auto* a = std::get_if<ElementField>(&first);
  const auto* b = std::get_if<ElementField>(&other);
  const bool alike = first.index() == other.index() && components_of(first) == components_of(other) &&
                     values_of(first).size() == values_of(other).size() &&
                     (a == nullptr || (a->support == b->support && a->starts == b->starts));
  if (!alike) throw Error("incompatible-field", "the field does not have the same points and components in all steps");
}

/// Whether a value goes before the one that has been the extreme so far.
bool goes_before(double value, double kept, ExtremeOverTime which) {
  if (std::isnan(kept)) return true;
  switch (which) {
    case ExtremeOverTime::greatest:
      return value > kept;
    case ExtremeOverTime::least:
      return value < kept;
    case ExtremeOverTime::least_magnitude:
      return std::abs(value) < std::abs(kept);
    default:
      return std::abs(value) > std::abs(kept);
  }
}

Field extreme_of_values(std::span<const FieldAtInstant> steps, ExtremeOverTime which, ExtremeShown shown) {
  Field result = *steps.front().field;
  auto& shown_values = values_of(result);
  std::vector<double> kept(shown_values.size(), absent);
  shown_values = kept;
  for (const FieldAtInstant& step : steps) {
    const auto& values = values_of(*step.field);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isnan(values[i]) || !goes_before(values[i], kept[i], which)) continue;
      kept[i] = values[i];
      shown_values[i] = shown == ExtremeShown::value ? kept[i] : step.instant;
    }
  }
  return result;
}

/// The columns of DX DY DZ that the field has.
std::vector<std::size_t> translations_of(const Field& field) {
  std::vector<std::size_t> columns;
  const auto& names = components_of(field);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == "DX" || names[i] == "DY" || names[i] == "DZ") columns.push_back(i);
  if (columns.empty()) throw Error("unknown-component", "the field has no translations DX, DY, DZ");
  return columns;
}

/// NaN where there is no translation.
double length_of(const double* row, const std::vector<std::size_t>& columns) {
  double square = 0.0;
  bool carried = false;
  for (const std::size_t column : columns) {
    if (std::isnan(row[column])) continue;
    carried = true;
    square += row[column] * row[column];
  }
  return carried ? std::sqrt(square) : absent;
}

Field longest_translation(std::span<const FieldAtInstant> steps, ExtremeShown shown) {
  const auto columns = translations_of(*steps.front().field);
  const std::size_t width = components_of(*steps.front().field).size();
  Field result = *steps.front().field;
  auto& target = values_of(result);
  const std::size_t rows = target.size() / width;
  std::vector<double> longest(rows, absent);
  target.assign(target.size(), absent);
  for (const FieldAtInstant& step : steps) {
    const auto& values = values_of(*step.field);
    for (std::size_t row = 0; row < rows; ++row) {
      const double length = length_of(values.data() + row * width, columns);
      if (std::isnan(length) || length <= longest[row]) continue;
      longest[row] = length;
      for (std::size_t i = row * width; i < (row + 1) * width; ++i)
        target[i] = shown == ExtremeShown::value || std::isnan(values[i]) ? values[i] : step.instant;
    }
  }
  return result;
}

}  // namespace

Field extreme_over_time(std::span<const FieldAtInstant> steps, ExtremeOverTime which, ExtremeShown shown) {
  for (const FieldAtInstant& step : steps) check_alike(*steps.front().field, *step.field);
  return which == ExtremeOverTime::longest_translation ? longest_translation(steps, shown)
                                                       : extreme_of_values(steps, which, shown);
}

Field between_instants(const FieldAtInstant& before, const FieldAtInstant& after, double instant) {
  check_alike(*before.field, *after.field);
  const double share = (instant - before.instant) / (after.instant - before.instant);
  return linear_combination(std::array{FieldTerm{before.field, 1.0 - share}, FieldTerm{after.field, share}});
}

}  // namespace comma::solver
