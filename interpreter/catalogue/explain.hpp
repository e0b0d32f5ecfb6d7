// The reference manual at the command line: `comma explain`, `comma explain COMMAND`, `comma explain
// COMMAND/KEYWORD/SUB`.
#pragma once

#include <string>
#include <string_view>

#include "interpreter/catalogue/catalogue.hpp"

namespace comma::interpreter {

/// All commands, by what one does with them.
std::string explain_all(const Catalogue& catalogue);

/// A command or a keyword of it. Throws DiagnosticError `unknown-command` or `unknown-keyword`, with the nearest name.
std::string explain(const Catalogue& catalogue, std::string_view path);

}  // namespace comma::interpreter
