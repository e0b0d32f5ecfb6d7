// Checks reuse=: whether the command changes a concept in place, and whether it is the one that its keywords name.
#pragma once

#include "interpreter/catalogue/check.hpp"
#include "interpreter/catalogue/check_value.hpp"

namespace comma::interpreter {

/// `reuse` is the argument as written, null when there is none. Completes the call's result and product type.
/// Code: bad-reuse.
void check_reuse(const CommandCall& written, const CommandPage& page, const Argument* reuse, CheckContext& context,
                 CheckedCall& checked);

}  // namespace comma::interpreter
