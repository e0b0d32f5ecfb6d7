// The stress of a solid seen from its skin (CALC_CHAMP, CONTRAINTE='SIRO_ELEM'; U4.81.04).
#pragma once

#include <span>

#include "solver/fields/field.hpp"

namespace comma::solver {

/// One value on each of the `faces` (skin cells of solids) that bounds a solid cell with stresses at element nodes (SIGM_ELNO): their
/// mean over the nodes of the face, with the face's normal n by the right-hand rule. Where solids lie on both sides, that whose outward
/// normal is n counts.
///
/// SIG_NX SIG_NY SIG_NZ: (n . S n) n, and SIG_N = n . S n; SIG_TX SIG_TY SIG_TZ: S n - (n . S n) n. The stress within the surface
/// has the principal values SIG_T1 <= SIG_T2, which times their directions are SIG_T1X ... SIG_T2Z; the largest component of the first
/// direction is negative, and n, the first and the second direction are right-handed.
ElementField surface_stresses(const Mesh& mesh, const ElementField& stresses, std::span<const int> faces);

}  // namespace comma::solver
