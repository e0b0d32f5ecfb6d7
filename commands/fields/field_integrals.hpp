// POST_ELEM/INTEGRALE: integrals and means of fields over cells, the skin, or along beams (U4.81.22).
#pragma once

#include "commands/tables/table.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// One row a step and part: VOL, and INTE_... and MOYE_... of each component. Throws DiagnosticError `no-element`,
/// `unknown-component`, `wrong-type`; alarms `cells-left-out`, `limited-field`.
void list_integrals(Table& table, const interpreter::Call& call, interpreter::Diagnostics& diagnostics);

}  // namespace comma::commands
