// The known name that looks most like a mistaken one, for the hints of errors.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace comma::solver {

/// The name at the smallest edit distance (Levenshtein) from `wanted`, letter case ignored; empty when none comes
/// closer than half of the letters.
std::string nearest_name(std::string_view wanted, std::span<const std::string> known);

}  // namespace comma::solver
