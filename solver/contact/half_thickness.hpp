// What the elements of a contact surface add to it: radii of beams, half thicknesses of plates.
#pragma once

#include <span>
#include <unordered_map>

#include "solver/contact/definition.hpp"
#include "solver/contact/facet.hpp"
#include "solver/elements/slender/section.hpp"
#include "solver/mesh/mesh.hpp"
#include "solver/model/model.hpp"

namespace comma::solver {

/// Radii of the beams among the cells (U4.44.11, DIST_POUTRE), of those that taper the mean of both ends. Throws Error
/// `unsupported` for a beam whose section is no circle, `missing-section` for one without a section.
std::unordered_map<int, double> beam_radii(const Model& model, const ElementProperties& properties,
                                           std::span<const int> cells);

/// Half of the thickness of the plates among the cells (U4.44.11, DIST_COQUE). Throws Error `missing-section` for one
/// without a thickness, `unsupported` for an eccentric one.
std::unordered_map<int, double> plate_half_thicknesses(const Model& model, const ElementProperties& properties,
                                                       std::span<const int> cells);

/// What the element of a cell adds (a length).
double half_thickness(const ContactZone& zone, int cell);

/// At each slave node of the zone the mean of what the slave cells add there; empty where none adds anything.
std::unordered_map<int, double> nodal_half_thickness(const ContactZone& zone, const Mesh& mesh);

}  // namespace comma::solver
