// What EXTR_TABLE() gives a command file: a table as Python has it, rows that are dicts (U1.03.02).
#pragma once

#include "commands/tables/table.hpp"
#include "interpreter/values/value.hpp"

namespace comma::commands {

/// An object that holds the rows as dicts, empty cells as None, and leaves out rows in which all are empty; loops run
/// through them, len() counts them, and what changes a row changes the table. T.INST is a column, T["INST"] the table
/// of it alone, T["INST", "DX"] the table of the two; T["A"] = list adds a column, `del T["A"]` removes one. rows, para
/// (the column names), titr; values() (lists by column), dict_CREA_TABLE() (what CREA_TABLE takes to make the table
/// again), copy(), append(row), extend(rows), sort(CLES, ORDRE), Array(x, y), Renomme(old, new), fromfunction(name,
/// function, parameters, const), difference(other), OrdreColonne(names), SansColonneVide(names). Printed as IMPR_TABLE
/// does. A column has values(), not_none_values(), length, items by number and by slice. Compared with a value or
/// several (T.INST > 0.5) it gives the table of the rows that pass, as do MAXI(), MINI(), MAXI_ABS(), MINI_ABS(),
/// VIDE(), NON_VIDE() and REGEXP(pattern); & and | join two such tables.
interpreter::Value extracted_table(const Table& table);

}  // namespace comma::commands
