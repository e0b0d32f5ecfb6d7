// What is odd about loads, told when they are made.
#pragma once

#include <string>

#include "commands/commands.hpp"
#include "commands/loads/load_building.hpp"

namespace comma::commands {

/// Of several values that occurrences of one keyword give to a component at a place the last counts (U1.03.00, rule of
/// overloading).
struct Overriding {
  std::string keyword{};
  std::ptrdiff_t count = 0;
  std::string example{};  ///< "DX at N1"
};

/// Alarm `overridden-value`, if there is one.
void warn_of(const Overriding& found, const interpreter::Span& at, const char* hint, Context& context);

/// Of a call of AFFE_CHAR_MECA: alarms `overridden-value`, `mixed-axes`, `inward-surface`, `lost-force`.
void warn_of_loads(const Call& call, const LoadedModel& target, Context& context);

}  // namespace comma::commands
