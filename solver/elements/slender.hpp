// What bars and beams of all kinds share.
#pragma once

#include <array>
#include <string_view>

#include "solver/elements/element_block.hpp"
#include "solver/model/stress_names.hpp"

namespace comma::solver {

/// The section of a bar or beam, with the values that the element needs positive. Throws Error `missing-properties`,
/// `invalid-properties`.
const BeamSection& slender_section(const BlockInput& input, int cell);

}  // namespace comma::solver
