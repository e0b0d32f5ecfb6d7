// Which rows of a table a FILTRE keeps (U4.91.03, section 3.4).
#pragma once

#include <vector>

#include "commands/table.hpp"
#include "interpreter/call.hpp"

namespace comma::commands {

/// Index of a column. Throws DiagnosticError `unknown-column` at `keyword` with the nearest name.
int column_of(const Table& table, const std::string& name, const interpreter::Keywords& keywords, const std::string& keyword = "NOM_PARA");

/// The rows that pass one FILTRE (NOM_PARA, CRIT_COMP, VALE, VALE_I, VALE_K, CRITERE, PRECISION), in their order.
Table filtered(const Table& table, const interpreter::Keywords& filter);

/// The numbers of a column, empty cells left out. Throws DiagnosticError `wrong-type` when it holds text.
std::vector<double> numbers_in(const Table& table, int column, const interpreter::Keywords& keywords);

}  // namespace comma::commands
