// How contact goes on from an earlier computation, and what it leaves to a later one.
#pragma once

#include <memory>
#include <vector>

#include "solver/contact_law/contact_memory.hpp"
#include "solver/contact_law/raised_penalties.hpp"
#include "solver/nonlinear/contact/faced_contact.hpp"

namespace comma::solver {

/// What a later computation must know of a step that has been accepted; null where its fields say all.
std::shared_ptr<const ContactMemory> contact_memory(const FacedContact& contact, const RaisedPenalties& penalties);

/// Zones that go on from others with the same penalties have these as they were raised.
void resume_penalties(const ContactDefinition& definition, const ContactMemory& memory, RaisedPenalties& penalties);

/// One a point: whether the computation before left it closed where it cannot open again.
std::vector<char> held_points(const FacedContact& contact, const ContactMemory& memory);

}  // namespace comma::solver
