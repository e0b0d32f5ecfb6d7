// Errors of the solver outside of commands, where the evaluator adds the place in the file.
#pragma once

#include "interpreter/diagnostic.hpp"
#include "solver/error.hpp"

namespace comma::commands {

/// What `code` gives, its solver::Error as a DiagnosticError without a place.
template <class Code>
auto diagnosed(Code&& code) {
  try {
    return code();
  } catch (const solver::Error& error) {
    throw interpreter::DiagnosticError(error.code(), error.what(), {}, error.hint());
  }
}

}  // namespace comma::commands
