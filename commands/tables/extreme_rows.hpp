// Extremes of the components of a field as rows of a table (POST_RELEVE_T, OPERATION='EXTREMA'; U4.81.21).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "commands/tables/table.hpp"
#include "solver/fields/data/statistics.hpp"

namespace comma::commands {

struct ComponentExtremes {
  std::string component;
  solver::Extremes found;
};

/// Of the components that any of the places (nodes or cells) carries.
std::vector<ComponentExtremes> extremes_of(const solver::Field& field, const std::vector<int>& components,
                                           const std::vector<int>& places);

/// One row a kind of extreme, over all components together: MAX, MIN, and MAXI_ABS and MINI_ABS, whose values are
/// magnitudes. `where`: the columns that say where an extreme lies. No row where there are no extremes.
void add_extremes(Table& table, const Row& head, const std::vector<ComponentExtremes>& all,
                  const std::function<Row(const solver::Extreme&)>& where);

}  // namespace comma::commands
