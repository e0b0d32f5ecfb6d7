// Reads one compiled page of the catalogue: MessagePack bytes -> the structures of catalogue.hpp.
// The bytes have the shape of the YAML page; interpreter/tools/catalogue_yaml.hpp describes and validates it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "interpreter/catalogue/catalogue.hpp"

namespace comma::interpreter {

/// The bytes come from a page that the build has validated. Throws std::exception on bytes that are damaged,
/// DiagnosticError on a condition that does not parse.
CommandPage decode_page(std::span<const std::uint8_t> bytes);
std::vector<ConceptTypePage> decode_types(std::span<const std::uint8_t> bytes);

}  // namespace comma::interpreter
