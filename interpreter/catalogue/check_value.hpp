// Checks the value of one simple keyword: type, number of values, allowed words, bounds.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "interpreter/catalogue/catalogue.hpp"
#include "interpreter/diagnostic.hpp"

namespace comma::interpreter {

/// What the checks of one call share.
struct CheckContext {
  const Catalogue& catalogue;
  Diagnostics& diagnostics;
  Severity unsupported = Severity::error;
  std::string without = {};  ///< a hint: what happens without what is not supported
  bool met_unsupported = false;
  bool met_open = false;  ///< a level has arguments that are not known
  /// Whose keywords are looked at: where a word is not known, another of them may have it.
  const LevelPage* level = nullptr;
  bool quiet = false;  ///< inside a keyword that was itself reported as unsupported

  void report_unsupported(std::string message, const Span& span);
};

/// The value as the command will see it (an int given for a real is a real; a keyword that admits several values holds
/// a tuple), or nothing after a report. `label` names the keyword in messages: "DEFI_CONTACT/ZONE/COULOMB". Unknown
/// values pass every check.
std::optional<Value> check_value(const Value& value, const KeywordPage& page, const std::string& label,
                                 const Span& span, CheckContext& context);

/// "a real number, or a function (fonction_sdaster)": what a keyword admits, in words.
std::string describe_types(const KeywordPage& page, const Catalogue& catalogue);

/// "at least 1 and below 5", or empty.
std::string describe_bounds(const Bounds& bounds);

/// "2 values", "at least 1 value", "1 to 3 values".
std::string describe_count(int min_count, int max_count, std::string_view noun);

}  // namespace comma::interpreter
