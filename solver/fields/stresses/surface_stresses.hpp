// The stress of a solid seen from its skin (CALC_CHAMP, CONTRAINTE='SIRO_ELEM'; U4.81.04).
#pragma once

#include <span>

#include "solver/fields/data/field.hpp"

namespace comma::solver {

/// One value on each of the `faces` (skin cells: faces of solids, edges of plane bodies) that bounds a cell with
/// stresses S at element nodes (SIGM_ELNO): their mean over the nodes of the face. The normal n of a face, the mean
/// over it where it is curved, follows the right-hand rule; that of an edge is its tangent t turned by -90 degrees.
/// Where cells lie on both sides, that whose outward normal is n counts.
///
/// Faces: SIG_NX SIG_NY SIG_NZ: (n . S n) n, and SIG_N = n . S n; SIG_TX SIG_TY SIG_TZ: S n - (n . S n) n. The stress
/// within the surface has the principal values SIG_T1 <= SIG_T2, which times their directions are SIG_T1X ... SIG_T2Z;
/// signs of the directions follow from the axes s, along the first edge from the second node to the first, and t = n x
/// s: the second direction leans towards t, or with the sign of the shear towards s where s is nearer; the first one
/// towards s, or else away from t.
///
/// Edges: SIG_NX ... = S n, SIG_N = n . S n, SIG_TX ... = SIG_T1X ... = S t, SIG_T1 = t . S t, SIG_TN = t . S n; SIG_T2
/// and SIG_T2Z are the stress across the plane, SIG_T2X and SIG_T2Y 0.
ElementField surface_stresses(const Mesh& mesh, const ElementField& stresses, std::span<const int> faces);

}  // namespace comma::solver
