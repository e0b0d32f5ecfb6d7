// Strains of continua and bars from displacements (CALC_CHAMP, DEFORMATION; U4.81.04).
#pragma once

#include <optional>

#include "solver/fields/data/field.hpp"
#include "solver/fields/points/continuum_points.hpp"
#include "solver/model/behaviour.hpp"

namespace comma::solver {

enum class StrainKind : std::uint8_t {
  total,             ///< EPSI: symmetric part of the displacement gradient
  mechanical,        ///< EPME: less the strain of the command variables
  green,             ///< EPSG: Green-Lagrange
  mechanical_green,  ///< EPMG: the same less the strain of the command variables
  logarithmic        ///< EPSL: ln(F^T F) / 2
};

/// Strains at the Gauss points of the stresses: EPXX EPYY EPZZ EPXY, with EPXZ EPYZ where the model has solids; tensor
/// components (half the shear angles). Bars have EPXX, along themselves, and a model of bars alone no other. In plane
/// stress EPZZ is that of the elastic law without stress across the plane. Throws Error `incompatible-field` where a
/// node of a continuum or bar has no displacement.
ElementField strains(const FieldInput& input, const NodalField& displacement, StrainKind kind);

/// EPSP: what is left of the mechanical strain of a displacement when the elastic strain of the stresses (SIEF_ELGA) is
/// taken away, in small strains; components as above. In plane stress EPZZ keeps the volume.
ElementField plastic_strains(const FieldInput& input, const NodalField& displacement, const ElementField& stresses);

/// EPFP, EPFD: strains of creep, which no law here has; components as above, bars have none.
ElementField creep_strains(const FieldInput& input, const NodalField& displacement);

/// A cell of a continuum, elastic in GREEN_LAGRANGE, that these displacements turn inside out at a Gauss point: the law
/// has stresses for that, and a body has not. Empty where there is none. Throws as strains() does.
std::optional<int> inverted_cell(const Model& model, const BehaviourOfCells& behaviours,
                                 const NodalField& displacement);

}  // namespace comma::solver
