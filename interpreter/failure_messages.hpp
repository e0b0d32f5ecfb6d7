// The message numbers that command files compare with: `if err.id_message == "MECANONLINE9_7"`.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace comma::interpreter {

/// Code_Aster's number of a failure, by the code of our diagnostic; the code itself where it has no number.
constexpr std::string_view message_id_of(std::string_view code) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> numbers = {{
      {"no-convergence", "MECANONLINE9_7"},
      {"contact-interpenetration", "CONTACT_93"},
      {"singular-matrix", "FACTOR_11"},
  }};
  for (const auto& [own, number] : numbers) {
    if (own == code) return number;
  }
  return code;
}

}  // namespace comma::interpreter
