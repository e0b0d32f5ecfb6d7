#include "commands/tables/extreme_rows.hpp"

#include <algorithm>
#include <cmath>

#include "solver/fields/data/field_rows.hpp"

namespace comma::commands {

std::vector<ComponentExtremes> extremes_of(const solver::Field& field, const std::vector<int>& components,
                                           const std::vector<int>& places) {
  std::vector<ComponentExtremes> all;
  for (const int component : components)
    if (const auto found = solver::extremes(field, component, std::span<const int>(places)))
      all.push_back({solver::components_of(field)[static_cast<std::size_t>(component)], *found});
  return all;
}

void add_extremes(Table& table, const Row& head, const std::vector<ComponentExtremes>& all,
                  const std::function<Row(const solver::Extreme&)>& where) {
  if (all.empty()) return;
  const auto add = [&](const char* name, solver::Extreme solver::Extremes::*kind, auto rank, auto shown) {
    const auto& [component, found] =
        *std::ranges::max_element(all, {}, [&](const auto& each) { return rank((each.found.*kind).value); });
    Row row = head;
    row.emplace_back("EXTREMA", std::string(name));
    const Row place = where(found.*kind);
    row.insert(row.end(), place.begin(), place.end());
    row.insert(row.end(), {{"CMP", component}, {"VALE", shown((found.*kind).value)}});
    table.add_row(row);
  };
  const auto value = [](double x) { return x; };
  const auto magnitude = [](double x) { return std::abs(x); };
  add("MAX", &solver::Extremes::greatest, value, value);
  add(
      "MIN", &solver::Extremes::least, [](double x) { return -x; }, value);
  add("MAXI_ABS", &solver::Extremes::greatest_magnitude, magnitude, magnitude);
  add(
      "MINI_ABS", &solver::Extremes::least_magnitude, [](double x) { return -std::abs(x); }, magnitude);
}

}  // namespace comma::commands
