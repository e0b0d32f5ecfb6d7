#include "solver/model/component.hpp"

#include <algorithm>
#include <array>

namespace comma::solver {

namespace {

constexpr std::array<std::string_view, component_count> names = {"DX", "DY", "DZ", "DRX", "DRY", "DRZ", "PRES", "GONF"};

}  // namespace

std::string_view name_of(Component component) { return names[static_cast<std::size_t>(component)]; }

std::optional<Component> component_named(std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Component>(found - names.begin());
}

}  // namespace comma::solver
