// Sections of plates from AFFE_CARA_ELEM.
#pragma once

#include "interpreter/graph/call.hpp"
#include "solver/fields/points/input_fields.hpp"

namespace comma::commands {

/// COQUE: gives the plates among the cells named their section, and keeps it for all of them in `named`. Throws
/// DiagnosticError `no-element` when none of the cells is a plate, `zero-vector` for a direction without length.
void add_plate_sections(const interpreter::Keywords& assignment, const solver::Model& model,
                        solver::ElementProperties& properties, solver::PlateSections& named);

}  // namespace comma::commands
