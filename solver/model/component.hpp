// The degrees of freedom a node can carry, by their usual names.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace comma::solver {

/// Translations, rotations, and what mixed elements have besides: the mean stress and the change of volume.
enum class Component : std::uint8_t { dx, dy, dz, drx, dry, drz, pressure, swelling };
inline constexpr int component_count = 8;
/// Translations and rotations come first.
inline constexpr int motion_count = 6;

inline constexpr std::array translation_components = {Component::dx, Component::dy, Component::dz};
constexpr bool is_rotation(Component component) {
  return component == Component::drx || component == Component::dry || component == Component::drz;
}
constexpr bool is_motion(Component component) { return static_cast<int>(component) < motion_count; }

std::string_view name_of(Component component);  ///< "DX" ...
std::optional<Component> component_named(std::string_view name);

/// A set of components, one bit each.
using ComponentMask = std::uint16_t;
constexpr ComponentMask mask_of(Component component) {
  return static_cast<ComponentMask>(1u << static_cast<unsigned>(component));
}
constexpr bool contains(ComponentMask mask, Component component) { return (mask & mask_of(component)) != 0; }

}  // namespace comma::solver
