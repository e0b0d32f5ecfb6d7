#include "solver/fields/data/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "solver/error.hpp"

namespace comma::solver {

LineMean line_mean(std::span<const double> abscissas, std::span<const double> values) {
  const double length = abscissas.empty() ? 0.0 : abscissas.back() - abscissas.front();
  if (!(length > 0.0)) throw Error("zero-vector", "a mean along a line needs at least two points at different places");
  LineMean result;
  result.least = *std::min_element(values.begin(), values.end());
  result.greatest = *std::max_element(values.begin(), values.end());
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double h = abscissas[i] - abscissas[i - 1];
    const double a = values[i - 1], b = values[i];
    const double s = 0.5 * (abscissas[i - 1] + abscissas[i]) - abscissas.front() - 0.5 * length;
    result.mean += 0.5 * h * (a + b);
    result.slope += h * (0.5 * (a + b) * s + h * (b - a) / 12.0);
  }
  result.mean /= length;
  result.slope *= 12.0 / (length * length);
  return result;
}

namespace {

void take(Extremes& extremes, double value, int place, int point) {
  const Extreme found{value, place, point};
  if (extremes.least.place < 0) extremes = {found, found, found, found};
  if (value < extremes.least.value) extremes.least = found;
  if (value > extremes.greatest.value) extremes.greatest = found;
  if (std::abs(value) < std::abs(extremes.least_magnitude.value)) extremes.least_magnitude = found;
  if (std::abs(value) > std::abs(extremes.greatest_magnitude.value)) extremes.greatest_magnitude = found;
}

}  // namespace

std::optional<Extremes> extremes(const Field& field, int component, std::optional<std::span<const int>> places) {
  Extremes result;
  const auto* nodal = std::get_if<NodalField>(&field);
  const auto visit = [&](int place) {
    const int points = nodal ? 1 : std::get<ElementField>(field).points(place);
    for (int point = 0; point < points; ++point) {
      const double value =
          nodal ? nodal->at(place, component) : std::get<ElementField>(field).at(place, point, component);
      if (!std::isnan(value)) take(result, value, place, point);
    }
  };
  if (places) {
    std::for_each(places->begin(), places->end(), visit);
  } else {
    const auto count =
        nodal ? nodal->values.size() / nodal->components.size() : std::get<ElementField>(field).starts.size() - 1;
    for (std::size_t place = 0; place < count; ++place) visit(static_cast<int>(place));
  }
  if (result.least.place < 0) return std::nullopt;
  return result;
}

}  // namespace comma::solver
