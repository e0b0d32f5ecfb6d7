// Turns a call as it was written into a call that a command can trust. Every problem of the call is reported, each
// once, at the keyword or the value that has it; see check_value.hpp for single values, check_rules.hpp for relations
// and stray_keywords.hpp for names that no keyword has.
#pragma once

#include <optional>
#include <string>

#include "interpreter/catalogue/catalogue.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/evaluation/host.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::interpreter {

struct CheckedCall {
  Call call;  ///< call.result is the reused concept, or null: the session makes the new one
  std::optional<std::string> product_type;  ///< see product_type.hpp
  bool sound = true;                        ///< no error was reported
  bool complete = true;                     ///< it may run: no value is unknown and comma supports everything in it
  bool left_out = false;                    ///< it only writes, and asks for something that comma does not support
};

/// Codes: unknown-keyword, duplicate-keyword, missing-keyword, wrong-type, wrong-concept-type, wrong-count,
/// out-of-bounds, unknown-word, too-many-occurrences, missing-one-of, exclusive-keywords, requires-keyword, bad-reuse,
/// unsupported. `unsupported` is the severity of the last one: an alarm while checking, an error before running; of a
/// command that only writes it is always an alarm.
CheckedCall check_call(const CommandCall& written, const CommandPage& page, const Catalogue& catalogue,
                       Diagnostics& diagnostics, Severity unsupported);

}  // namespace comma::interpreter
