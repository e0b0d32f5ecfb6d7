// What bars and beams of all kinds share.
#pragma once

#include <array>
#include <string_view>

#include "solver/elements/element_block.hpp"

namespace comma::solver {

inline constexpr std::array<std::string_view, 6> beam_force_names = {"N", "VY", "VZ", "MT", "MFY", "MFZ"};

/// The section of a bar or beam, with the values that the element needs positive. Throws Error `missing-properties`, `invalid-properties`.
const BeamSection& slender_section(const BlockInput& input, int cell);

}  // namespace comma::solver
