// Area, centre and inertia of meshed sections (POST_ELEM, CARA_GEOM; U4.81.22).
#pragma once

#include "commands/tables/table.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// One row a section.
void list_sections(Table& table, const interpreter::Call& call);

}  // namespace comma::commands
