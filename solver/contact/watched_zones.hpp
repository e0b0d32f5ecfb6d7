// Zones where contact is not enforced but watched (U4.44.11, RESOLUTION='NON').
#pragma once

#include <cstddef>
#include <map>

#include "solver/contact/doubts.hpp"
#include "solver/contact/pairing.hpp"

namespace comma::solver {

/// The pairs of watched zones with the surfaces at given places, by their number among all pairs of the definition.
/// Their gaps are gap_at(), less thicknesses, as where contact is enforced. Throws what pair_surfaces throws.
std::map<std::size_t, ContactPair> watched_pairs(const ContactDefinition& contact, const Mesh& mesh, Positions now,
                                                 double instant);

/// For STOP_INTERP='OUI': throws Error `contact-interpenetration` where a watched node lies deeper than its zone
/// allows.
void require_no_interpenetration(const ContactDefinition& contact, const Mesh& mesh, Positions now, double instant);

/// For STOP_INTERP='NON': the doubt `watched_overlap` of such nodes.
void note_interpenetration(const ContactDefinition& contact, const Mesh& mesh, Positions now, double instant,
                           ContactDoubts& doubts);

}  // namespace comma::solver
