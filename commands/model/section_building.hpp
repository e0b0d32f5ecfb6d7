// Cross-sections of bars and beams from the names and values of AFFE_CARA_ELEM.
#pragma once

#include "interpreter/graph/call.hpp"
#include "solver/elements/slender/section.hpp"

namespace comma::commands {

/// POUTRE: assigns sections to the beams among the cells named, and softens them then (SECTION="COUDE"): of several
/// that name a cell the last one of either kind counts. Throws DiagnosticError `no-element` when none of the cells is a
/// beam, `wrong-count` when CARA and VALE do not agree, `missing-characteristic`, `duplicate-characteristic`,
/// `excluded-characteristic`, `invalid-section`.
void add_beam_sections(const std::vector<interpreter::Keywords>& assignments, const solver::Model& model,
                       solver::ElementProperties& properties);

/// BARRE: the same for bars.
void add_bar_sections(const interpreter::Keywords& assignment, const solver::Model& model,
                      solver::ElementProperties& properties);

}  // namespace comma::commands
