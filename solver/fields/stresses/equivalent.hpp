// Invariants and principal values of stresses and strains (CALC_CHAMP, CRITERES: SIEQ, EPEQ, EPMQ, EPGQ; U4.81.04).
#pragma once

#include <Eigen/Dense>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

struct Principal {
  Eigen::Vector3d values;   ///< rising
  Eigen::Matrix3d vectors;  ///< columns, of length 1
};
Principal principal(const Eigen::Matrix3d& tensor);

/// sqrt(3/2 s:s) with the deviator s.
double von_mises(const Eigen::Matrix3d& stress);
/// The largest difference of principal values.
double tresca(const Eigen::Matrix3d& stress);

/// VMIS, TRESCA, PRIN_1 <= PRIN_2 <= PRIN_3, VMIS_SG (VMIS with the sign of the trace), VECT_1_X ... VECT_3_Z
/// (principal directions), TRSIG (trace), TRIAX (a third of the trace over VMIS; 0 where that is 0). Takes SIXX SIYY
/// SIZZ SIXY (SIXZ SIYZ); cells and nodes without stresses have none. Throws Error `incompatible-field` for a field
/// without these components.
ElementField equivalent_stresses(const ElementField& stresses);
NodalField equivalent_stresses(const NodalField& stresses);

/// INVA_2 = sqrt(2/3 e:e) with the deviator e, PRIN_1 ... PRIN_3, INVA_2SG (with the sign of the trace), VECT_1_X ...
/// VECT_3_Z. Takes EPXX EPYY EPZZ EPXY (EPXZ EPYZ), tensor components, or EPXX alone (of bars, in their own axes).
ElementField equivalent_strains(const ElementField& strains);
NodalField equivalent_strains(const NodalField& strains);

/// Of stresses or strains: VMIS = sqrt(3/2 d:d) with the deviator d, TRESCA (largest difference of principal values),
/// TRACE, DETER (determinant).
NodalField tensor_invariants(const NodalField& tensors);

/// Of stresses or strains: PRIN_1 <= PRIN_2 <= PRIN_3 and their directions VECT_1_X ... VECT_3_Z.
NodalField principal_values(const NodalField& tensors);

}  // namespace comma::solver
