// The work that forces on the nodes have done since the start (POST_ELEM TRAV_EXT, U4.81.22).
#pragma once

#include <vector>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// At each step of a result, with its displacements u (DEPL) and nodal forces F (FORC_NODA): `elastic` = F . u / 2, the
/// work had they grown in proportion; `real` = the sum over the steps so far of (F_n + F_(n-1)) . (u_n - u_(n-1)) / 2.
/// The first step has done no `real` work, whatever its forces (so has it Code_Aster 17.3). The components that both
/// fields have count. Throws Error `unknown-field` naming what a step lacks.
struct ExternalWork {
  double elastic = 0.0;
  double real = 0.0;
};
std::vector<ExternalWork> external_work(const Result& result);

}  // namespace comma::solver
