// Visiting the occurrences of a factor keyword.
#pragma once

#include <string>

#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/error.hpp"

namespace comma::commands {

/// visit(occurrence) for each; an error of the solver in one is told there, under COMMAND/FACTOR.
template <class Visit>
void each_occurrence(const interpreter::Call& call, const std::string& factor, Visit visit) {
  for (const interpreter::Keywords& occurrence : call.factors(factor)) {
    try {
      visit(occurrence);
    } catch (const solver::Error& error) {
      throw interpreter::DiagnosticError(error.code(), call.command + "/" + factor + ": " + error.what(),
                                         occurrence.span, error.hint());
    }
  }
}

}  // namespace comma::commands
