// What a text that could not be read would have bound: needed so that a broken statement makes one error, and not one
// more at each use of its names.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "interpreter/source.hpp"

namespace comma::interpreter {

struct LostNames {
  std::vector<Span> names;  ///< where each one stands in the text; the same name may be there more than once
  bool any = false;         ///< whole sets of names are lost: `from m import *`, INCLUDE
};

/// Looks through [begin, end) of the file, word by word: targets of assignments, of `for`, `def`, `import` and `as`,
/// names that are changed in place (x.append(...), x[0] = ..., reuse=x). `column` is the indentation of the broken
/// statement. In doubt a name counts as lost: it costs a check, and never gives a wrong error.
LostNames lost_names(const std::shared_ptr<const SourceFile>& file, std::uint32_t begin, std::uint32_t end, int column);

}  // namespace comma::interpreter
