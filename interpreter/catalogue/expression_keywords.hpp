// Keywords that hold an expression as a text, such as VALE of FORMULE. The text may use variables of the file: older
// files just name them, newer ones pass them as further keywords (a=a). Here the older form becomes the newer one, so
// that the check, the graph and the command see but one.
#pragma once

#include "interpreter/catalogue/catalogue.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/evaluation/host.hpp"

namespace comma::interpreter {

/// Adds an argument for each variable of the file that an expression of the call uses, unless the call gives it itself
/// or a keyword of type `parameter` names it. Reports expressions that cannot be read (`syntax`) and names that mean
/// nothing
/// (`unknown-name`) where the expression stands; false if there are any.
bool bind_expressions(CommandCall& call, const CommandPage& page, Diagnostics& diagnostics);

}  // namespace comma::interpreter
