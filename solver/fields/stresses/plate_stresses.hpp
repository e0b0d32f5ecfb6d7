// Stresses and strains of plates at places in their thickness, and the layer that is taken out of such a field
// (POST_CHAMP, EXTR_COQUE; U4.81.05).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "solver/elements/slender/section.hpp"
#include "solver/fields/data/field.hpp"
#include "solver/fields/stresses/plate_forces.hpp"

namespace comma::solver {

/// SIXX SIYY SIZZ SIXY SIXZ SIYZ in the plate's own axes out of NXX ... QY (moments about the surface of the mesh), on
/// the plates of the field: in each layer, from the lowest on, at its lower side, in its middle and at its upper side.
/// Linear through the thickness, SIZZ zero, the transverse shears a parabola that vanishes on both faces (R3.07.03).
/// Throws Error `unknown-component`, `missing-properties`.
ElementField plate_stresses(const Model& model, const ElementProperties& properties, const ElementField& forces);

/// The way back at one point: NXX ... QY out of the stresses at all places in the thickness, one after the other.
/// Nothing where these are not what any forces make of them, to six digits of the largest.
std::optional<PlateForces> forces_of_plate_stresses(const PlateSection& section, std::span<const double> stresses);

/// EPXX EPYY EPZZ EPXY EPXZ EPYZ at the same places out of EXX ... GAY (plate_strains(), about the surface of the
/// mesh): linear through the thickness, EPXZ and EPYZ half of GAX and GAY all through it, EPZZ zero, for the theory of
/// plates leaves the thickness as it is (R3.07.03). Throws Error `missing-properties`.
ElementField plate_layer_strains(const Model& model, const ElementProperties& properties, const ElementField& strains);

enum class LayerSide : std::uint8_t { lower, middle, upper };

/// Of the cell that has the most.
int most_layers(const ElementField& field);

/// One place in the thickness, of the cells that have several and at least `layer` (from 1) layers; other cells have
/// none.
ElementField values_in_layer(const ElementField& field, int layer, LayerSide side);

}  // namespace comma::solver
