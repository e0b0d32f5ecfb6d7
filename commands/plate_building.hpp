// Sections of plates from AFFE_CARA_ELEM.
#pragma once

#include "interpreter/call.hpp"
#include "solver/elements/section.hpp"

namespace comma::commands {

/// COQUE: gives the plates among the cells named their section. Throws DiagnosticError `no-element` when none of the cells is
/// a plate, `zero-vector` for a direction without length.
void add_plate_sections(const interpreter::Keywords& assignment, const solver::Model& model, solver::ElementProperties& properties);

}  // namespace comma::commands
