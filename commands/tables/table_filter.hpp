// Which rows and columns of a table are meant, and in which order (U4.91.03, sections 3.3 and 3.4).
#pragma once

#include <optional>
#include <vector>

#include "commands/tables/table.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// Index of a column. Throws DiagnosticError `unknown-column` at `keyword` with the nearest name.
int column_of(const Table& table, const std::string& name, const interpreter::Keywords& keywords,
              const std::string& keyword = "NOM_PARA");

/// The same for each name of NOM_PARA.
std::vector<int> columns_of(const Table& table, const interpreter::Keywords& keywords);

/// These columns alone, in this order.
Table with_columns(const Table& table, const std::vector<int>& columns);

/// All but these columns.
Table without_columns(const Table& table, const std::vector<int>& columns);

/// Orders the rows by the columns of NOM_PARA, upwards or downwards (ORDRE); rows that agree come in the reverse of
/// their order, as in Code_Aster 17.3. Rising, empty cells come before numbers, and these before texts.
void sort_rows(Table& table, const interpreter::Keywords& keywords);

/// The rows that pass one FILTRE (NOM_PARA, CRIT_COMP, VALE, VALE_I, VALE_K, CRITERE, PRECISION), in their order.
Table filtered(const Table& table, const interpreter::Keywords& filter);

/// The numbers of a column, empty cells left out. Throws DiagnosticError `wrong-type` when it holds text.
std::vector<double> numbers_in(const Table& table, int column, const interpreter::Keywords& keywords);

}  // namespace comma::commands
