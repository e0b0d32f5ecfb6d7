// Regular expressions, for the few methods that take one (assertRaisesRegex, a column's REGEXP); the module re is not
// there.
#pragma once

#include <string>

namespace comma::interpreter {

/// Whether the pattern is found anywhere in the text, as by Python's re.search. The search takes time in proportion to
/// both lengths, whatever the pattern. Raises ValueError for a pattern that cannot be read: groups that have a name or
/// look around are none of it.
bool finds_pattern(const std::string& text, const std::string& pattern);

}  // namespace comma::interpreter
