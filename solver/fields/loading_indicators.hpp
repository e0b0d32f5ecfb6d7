// How far a loading is from proportional, where it unloads (R4.20.01).
#pragma once

#include "solver/fields/continuum_points.hpp"
#include "solver/fields/field.hpp"
#include "solver/model/behaviour.hpp"

namespace comma::solver {

/// DERA_ELGA: what stresses do from one step to the next, at each point of both fields. DCHA_V, DCHA_T: (|after| -
/// |before|) / |after|, with the norm sqrt(3/2 s : s) of the deviators and of the whole stresses; negative where the
/// point unloads. RADI_V: 1 - |before : change| / (|before| |change|) of the deviators, 0 where they go on in their
/// direction. Each is 0 where a norm that divides is. Throws Error `incompatible-field` for fields on different points.
ElementField local_indicators(const ElementField& before, const ElementField& after);

/// What the global indicators need at Gauss points: plastic strains (EPSP), stresses and internal variables, of
/// materials with isotropic von Mises plasticity or none.
struct PlasticFields {
  const ElementField& plastic_strains;
  const ElementField& stresses;
  const ElementField& variables;
  const BehaviourOfCells* behaviours;  ///< null: all cells are elastic
};

/// INDIC_SEUIL at each point: 1 - |stress : plastic strain| / (R(p) p), with R(p) the radius of the yield surface; 0
/// where p is. It is 1 where the stress does not work on the plastic strain, or where there is none left. Throws Error
/// `unsupported` for a cell whose hardening is not isotropic or whose strains are large.
ElementField yield_indicator(const FieldInput& input, const PlasticFields& fields);

/// INDIC_ENER at each point: 1 - psi / w, w being the energy that the material has taken up, elastic and by R(p), and
/// psi what it would have taken up on the straight way to its strain. 0 where w is. Throws what yield_indicator() does.
ElementField energy_indicator(const FieldInput& input, const PlasticFields& fields);

}  // namespace comma::solver
