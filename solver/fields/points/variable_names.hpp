// What internal variables are called (NOM_VARI; U4.51.11 and the pages R5.03 of the laws).
#pragma once

#include <string>
#include <vector>

#include "solver/fields/data/field.hpp"
#include "solver/model/behaviour.hpp"

namespace comma::solver {

/// The names of V1, V2 ... of a behaviour: EPSPEQ (cumulated plastic strain) and INDIPLAS (1 where it flows) of
/// isotropic hardening, with saturating exponentials EPSPXX ... EPSPYZ as well; XCINXX ... XCINYZ (back stress) and
/// INDIPLAS of kinematic hardening; all of them of both together; VIDE of elasticity. Logarithmic strains add TXX ...
/// TYZ. Empty for a behaviour whose variables have no names in comma.
std::vector<std::string> variable_names(const CellBehaviour& behaviour);

/// A field V1, V2 ... with the names as components. At the nodes of the mesh a name is known where it has the same
/// number in all behaviours that have it. No behaviours: linear elasticity everywhere. Throws Error
/// `incompatible-field` for a field without V1.
Field by_variable_names(const Field& field, const BehaviourOfCells* behaviours);

}  // namespace comma::solver
