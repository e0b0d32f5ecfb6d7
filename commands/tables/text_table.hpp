// Tables in text files (LIRE_TABLE, U7.02.03), and numbers in columns (LIRE_FONCTION, U4.32.02).
#pragma once

#include <fstream>
#include <istream>
#include <string>
#include <vector>

#include "commands/context.hpp"
#include "commands/tables/table.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// The input file of UNITE, which the console tells of; `extensions` as Files::input() takes them. Throws
/// DiagnosticError `missing-file`.
std::ifstream open_input(const interpreter::Call& call, Context& context, const std::vector<std::string>& extensions);

/// FORMAT='ASTER': the `number`-th (from 1) of the tables between #DEBUT_TABLE and #FIN_TABLE: names, types, rows.
/// Throws solver::Error `unreadable-table` with the line, `unknown-table` where there are fewer.
Table read_aster_table(std::istream& file, const std::string& separator, int number);

/// FORMAT='TABLEAU' and 'LIBRE': lines that begin with # are comments, the first of the others are names. A column is
/// one of integers, of reals or of texts by what stands in it. Throws as above.
Table read_plain_table(std::istream& file, const std::string& separator, int number);

/// Rows of numbers; lines with something else end a block. `separator`: empty for blanks.
using NumberBlock = std::vector<std::vector<double>>;
std::vector<NumberBlock> read_number_blocks(std::istream& file, const std::string& separator);

}  // namespace comma::commands
