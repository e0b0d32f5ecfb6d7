// Angles, which command files give in degrees.
#pragma once

#include <numbers>

namespace comma::commands {

inline constexpr double degree = std::numbers::pi / 180.0;

}  // namespace comma::commands
