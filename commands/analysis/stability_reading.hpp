// CRIT_STAB in the solver's words.
#pragma once

#include "commands/commands.hpp"

namespace comma::commands {

/// The modes that CRIT_STAB asks for, which are written into the table of a result as they come; nothing where it is
/// not given.
std::optional<solver::StabilityAnalysis> stability_analysis(const Call& call, ResultConcept& product);

}  // namespace comma::commands
