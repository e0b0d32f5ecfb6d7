// Checks the relations between the keywords of one level: exactly one of, at least one of, all or none, ...
#pragma once

#include <string>
#include <vector>

#include "interpreter/catalogue/catalogue.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::interpreter {

/// A keyword of the level that the file gives; defaults do not count for rules.
struct GivenKeyword {
  std::string name;
  Span name_span;
  bool is_guess = false;  ///< what a misspelt one may have meant: nothing is missing then, and nothing too much
};

/// Codes: missing-one-of, exclusive-keywords, requires-keyword. `label` names the level ("DEFI_CONTACT/ZONE"); `span`
/// is where something is missing.
void check_rules(const std::vector<RulePage>& rules, const std::vector<GivenKeyword>& given, const std::string& label,
                 const Span& span, Diagnostics& diagnostics);

/// "exactly one of TOUT, GROUP_MA", as `explain` tells it.
std::string describe_rule(const RulePage& rule);

}  // namespace comma::interpreter
