// What EXTR_TABLE() gives a command file: the columns of a table as Python's values (U1.03.02).
#pragma once

#include "commands/table.hpp"
#include "interpreter/value.hpp"

namespace comma::commands {

/// An object with the columns as attributes (T.INST.values() is a list) or items (T["INST"]; T["INST", "DX"] is the table of the two), values()
/// (lists by column), para (the column names), rows (dicts without empty cells), dict_CREA_TABLE() (what CREA_TABLE takes to make the table again) and a length, its number of rows; printed as IMPR_TABLE does. A column compared with a value
/// (T.INST > 0.5) gives the table of the rows that pass; & and | join two such tables.
interpreter::Value extracted_table(const Table& table);

}  // namespace comma::commands
