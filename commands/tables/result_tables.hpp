// The tables that a result keeps (RECU_TABLE, U4.71.02).
#pragma once

#include <optional>
#include <string_view>

#include "commands/concepts.hpp"

namespace comma::commands {

/// A parameter of a step in a table: an integer where it counts something.
Cell parameter_cell(std::string_view parameter, double value);

/// PARA_CALC: one row a step that was computed, with what the computation says of it; OBSERVATION where some was asked
/// for. Nothing for another name.
std::optional<Table> table_of_result(const ResultConcept& data, std::string_view name);

}  // namespace comma::commands
