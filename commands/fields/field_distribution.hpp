// POST_ELEM: norms of fields and the volumes in which their values lie (U4.81.22, NORME and VOLUMOGRAMME).
#pragma once

#include "commands/tables/table.hpp"
#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// One row a step and part: TYPE_NORM and VALE_NORM, the root of the integral over the part of the sum of squares.
/// Throws DiagnosticError `no-element`; alarm `cells-left-out`.
void list_norms(Table& table, const interpreter::Call& call, interpreter::Diagnostics& diagnostics);

/// One row an interval of the values: INTERVALLE (its number), BORNE_INF, BORNE_SUP and DISTRIBUTION, the volume or its
/// share. Throws and warns alike.
void list_distributions(Table& table, const interpreter::Call& call, interpreter::Diagnostics& diagnostics);

}  // namespace comma::commands
