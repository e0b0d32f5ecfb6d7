// Where one item of a tuple or list stands, for diagnostics that mean this one and not the whole.
#pragma once

#include <cstddef>

#include "interpreter/source.hpp"

namespace comma::interpreter {

/// The place of item `index` of a display of `count` items that is written out at `whole`: the 'B' of ('A', 'B').
/// `whole` itself when the value is written otherwise there (a variable, a comprehension, a sum of tuples).
Span item_span(const Span& whole, std::size_t index, std::size_t count);

}  // namespace comma::interpreter
