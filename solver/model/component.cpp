#include "solver/model/component.hpp"

#include <algorithm>
#include <array>

namespace comma::solver {

namespace {

constexpr std::array<std::string_view, component_count> component_names = {"DX",  "DY",  "DZ",   "DRX",
                                                                           "DRY", "DRZ", "PRES", "GONF"};

}  // namespace

std::string_view name_of(Component component) { return component_names[static_cast<std::size_t>(component)]; }

std::optional<Component> component_named(std::string_view name) {
  const auto found = std::find(component_names.begin(), component_names.end(), name);
  if (found == component_names.end()) return std::nullopt;
  return static_cast<Component>(found - component_names.begin());
}

}  // namespace comma::solver
