// What can be said of a statement without running it: needed where a condition is unknown or an error ended it.
#pragma once

#include <vector>

#include "interpreter/syntax/ast.hpp"

namespace comma::interpreter {

/// The variables that the statement, or any statement in it, binds or changes (the d of d["a"] = 1 too).
std::vector<const NameNode*> bound_names(const Statement& statement);

struct Exits {
  bool returns = false;
  bool leaves_loop = false;  ///< break or continue of a loop around the statement
};
Exits exits_of(const Statement& statement);

}  // namespace comma::interpreter
