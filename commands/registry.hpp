// From a command's name to its function.
#pragma once

#include "commands/commands.hpp"
#include "interpreter/graph/executor.hpp"

namespace comma::commands {

/// All commands that comma runs, by name. A solver::Error becomes a DiagnosticError at the call.
/// `context` must outlive the table.
interpreter::CommandTable make_command_table(Context& context);

/// Of commands that solve, what tells their errors before they do; where nothing will be solved (Context::only_checks),
/// their alarms too.
interpreter::CommandTable make_preparation_table(Context& context);

}  // namespace comma::commands
