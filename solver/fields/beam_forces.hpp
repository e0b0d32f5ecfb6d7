// Section forces at the ends of beams that carry distributed loads (EFGE_ELNO; U4.81.04, R3.08.01).
#pragma once

#include <span>

#include "solver/elements/external_forces.hpp"
#include "solver/fields/field.hpp"

namespace comma::solver {

/// Section forces at element nodes (N VY VZ MT MFY MFZ as elements have them) out of SIEF_ELNO. In
/// beams under forces per length, weight or rotation the ends' displacements alone leave out what the load does between
/// them: its end forces are taken away, so that the free end of a loaded cantilever has none. Throws what
/// add_external_forces throws.
ElementField end_section_forces(const ForceInput& input, const ElementField& at_nodes,
                                std::span<const AppliedLoad> loads, double time);

}  // namespace comma::solver
