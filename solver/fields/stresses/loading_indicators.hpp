// How far a loading is from proportional, where it unloads (R4.20.01).
#pragma once

#include "solver/fields/data/field.hpp"
#include "solver/fields/points/continuum_points.hpp"
#include "solver/model/behaviour.hpp"

namespace comma::solver {

/// What DERA_ELGA of a step is made from, at Gauss points.
struct LoadingFields {
  const ElementField& stresses;
  const ElementField& next_stresses;     ///< of the next step
  const ElementField* variables;         ///< null: nothing has a memory
  const ElementField* next_variables;    ///< of the next step; null with `variables`
  const BehaviourOfCells* behaviours;    ///< null: all cells are elastic
  const ElementField* before = nullptr;  ///< DERA_ELGA of the step before; null: this is the first one
};

/// DERA_ELGA: what stresses do from one step to the next, at each point; all zeros at the first step. DCHA_V, DCHA_T:
/// (|after| - |before|) / |after|, with the norm sqrt(3/2 s : s) of the deviators (about the back stress of
/// VMIS_CINE_LINE) and of the whole stresses; negative where the point unloads. Of von Mises plasticity: ERR_RADI, half
/// the distance between the normals of the two steps where both flow. Of isotropic hardening: RADI_V, 1 - |before :
/// change| / (|before| |change|) of the deviators, 0 where they go on in their direction; IND_DCHA, 0 at first, 1 as
/// long as nothing has flowed, 2 where it flows, -1 where it unloads, -2 where kinematic hardening might flow back,
/// which stays so; X11 to X23, the stress at the last flow less the part within the initial yield surface (with
/// ECRO_PUIS all of it); VAL_DCHA, how far -2 is beyond. VAL_DCHA takes IND_DCHA, VAL_DCHA, X11 ... of the step before
/// for X11, X22, X33 ..., two places off, as Code_Aster 17.3 does, and a norm without the factor 3/2. Each is 0 where a
/// norm that divides is. Throws Error `incompatible-field` for fields on different points.
ElementField local_indicators(const FieldInput& input, const LoadingFields& fields);

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
