// The nearest of several numbers: of the instants of a list, of the steps of a result.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <ranges>

namespace comma::commands {

/// Index of the member whose number (by `number_of`) is nearest to the wanted one, of those within `reach` of it; the
/// first of equals.
template <std::ranges::random_access_range Members, class NumberOf = std::identity>
std::optional<std::size_t> nearest_within(const Members& members, double wanted, double reach,
                                          NumberOf number_of = {}) {
  const auto distance = [&](const auto& member) { return std::abs(std::invoke(number_of, member) - wanted); };
  const auto found = std::ranges::min_element(members, {}, distance);
  if (found == std::ranges::end(members) || distance(*found) > reach) return std::nullopt;
  return static_cast<std::size_t>(found - std::ranges::begin(members));
}

}  // namespace comma::commands
