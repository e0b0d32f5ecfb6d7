// Pairs of keywords that are bounds of the same quantity.
#pragma once

#include <fmt/format.h>

#include <string>

#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// Throws DiagnosticError `contradictory-keywords` where the least is above the most. Either may be absent.
inline void require_order(const interpreter::Keywords& keywords, const std::string& least, const std::string& most) {
  if (!keywords.has(least) || !keywords.has(most) || keywords.real(least) <= keywords.real(most)) return;
  const std::string& named = keywords.given(least) ? least : most;
  throw interpreter::DiagnosticError(
      "contradictory-keywords",
      fmt::format("{} is {}, which is more than {}, {}", least, keywords.real(least), most, keywords.real(most)),
      keywords.span_of(named));
}

}  // namespace comma::commands
