// Reads one compiled page of the catalogue: MessagePack bytes -> JSON -> the structures of catalogue.hpp.
// The YAML page and the JSON have the same shape; interpreter/tools/catalogue_yaml.hpp describes and validates it.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "interpreter/catalogue.hpp"

namespace comma::interpreter {

/// Throws std::runtime_error on bytes that the build did not write.
CommandPage decode_page(std::span<const std::uint8_t> bytes);
std::vector<ConceptTypePage> decode_types(std::span<const std::uint8_t> bytes);

/// `json` has been validated; throws nlohmann::json::exception or DiagnosticError (a condition that does not parse) if not.
CommandPage page_from_json(const nlohmann::ordered_json& json);

}  // namespace comma::interpreter
