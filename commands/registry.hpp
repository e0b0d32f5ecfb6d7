// From a command's name to its function.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "commands/commands.hpp"

namespace comma::commands {

/// What the executor runs. A solver::Error becomes a DiagnosticError at the call; with reuse= and no new data returned, the
/// concept keeps the data that the function changed in place.
using CommandTable = std::map<std::string, std::function<Product(const Call&)>, std::less<>>;

/// `context` must outlive the table.
CommandTable make_command_table(Context& context);

}  // namespace comma::commands
