#include "solver/materials/mean_expansion.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>

#include "solver/error.hpp"

namespace comma::solver {
namespace {

/// alpha'(T_r), over the points of the table that are not too near.
double slope_at(double reference, double value, const TabulatedFunction& table, double nearness) {
  double sum = 0.0;
  int sides = 0;
  const auto add = [&](std::size_t i) {
    sum += (table.y[i] - value) / (table.x[i] - reference);
    ++sides;
  };
  const auto above = std::upper_bound(table.x.begin(), table.x.end(), reference + nearness);
  const auto not_below = std::lower_bound(table.x.begin(), table.x.end(), reference - nearness);
  if (not_below != table.x.begin()) add(static_cast<std::size_t>(not_below - table.x.begin()) - 1);
  if (above != table.x.end()) add(static_cast<std::size_t>(above - table.x.begin()));
  return sides > 0 ? sum / sides : 0.0;
}

struct Converted {
  double reference = 0.0;
  TabulatedFunction table;
};

}  // namespace

TabulatedFunction expansion_from(double reference, const TabulatedFunction& measured, double definition_temperature,
                                 double nearness) {
  TabulatedFunction table = measured;
  const double value = measured(reference);
  const double span = reference - definition_temperature;
  for (std::size_t i = 0; i < table.x.size(); ++i) {
    const double t = measured.x[i];
    const bool is_near = std::abs(t - reference) <= nearness;
    table.y[i] = is_near ? value + slope_at(reference, value, measured, nearness) * span
                         : (measured.y[i] * (t - definition_temperature) - value * span) / (t - reference);
  }
  return table;
}

Property mean_expansion(TabulatedFunction measured, double definition_temperature, double nearness) {
  // All points of a body have one reference, as a rule: the last table is kept.
  auto last = std::make_shared<std::atomic<std::shared_ptr<const Converted>>>();
  return Property([measured = std::move(measured), definition_temperature, nearness, last](const MaterialPoint& at) {
    const double temperature = at[Parameter::temperature];
    const double reference = at.reference(Parameter::temperature);
    if (std::isnan(temperature))
      throw Error("missing-variable", "the thermal expansion depends on the temperature, which is not given here",
                  "assign the temperature to these cells");
    if (std::isnan(reference)) throw Error("missing-reference", "a temperature is given without its reference value");
    std::shared_ptr<const Converted> converted = last->load();
    if (!converted || converted->reference != reference) {
      converted = std::make_shared<const Converted>(
          Converted{reference, expansion_from(reference, measured, definition_temperature, nearness)});
      last->store(converted);
    }
    return converted->table(temperature);
  });
}

}  // namespace comma::solver
