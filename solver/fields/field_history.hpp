// One field out of those of several steps: extremes over time, values between two instants (CREA_CHAMP, EXTR;
// U4.72.04).
#pragma once

#include <span>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

struct FieldAtInstant {
  double instant = 0.0;
  const Field* field = nullptr;
};

enum class ExtremeOverTime : std::uint8_t {
  greatest,
  least,
  greatest_magnitude,  ///< the value that has it, with its sign
  least_magnitude,
  longest_translation  ///< all components of the step at which DX DY DZ of the place are longest
};
enum class ExtremeShown : std::uint8_t { value, instant };

/// At each point and component the extreme over the steps, or the instant at which it is first reached; what no step
/// carries stays absent. Throws Error `incompatible-field` for fields of other points or components,
/// `unknown-component` for translations that the field lacks.
Field extreme_over_time(std::span<const FieldAtInstant> steps, ExtremeOverTime which, ExtremeShown shown);

/// Linear between two steps. Throws Error `incompatible-field`.
Field between_instants(const FieldAtInstant& before, const FieldAtInstant& after, double instant);

}  // namespace comma::solver
