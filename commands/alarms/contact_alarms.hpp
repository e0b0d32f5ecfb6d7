// What DEFI_CONTACT tells about a definition that is allowed and likely not what is meant.
#pragma once

#include "interpreter/diagnostic.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/contact/definition.hpp"
#include "solver/model/model.hpp"

namespace comma::commands {

/// Alarms `few-points`, `shared-slave-nodes`, `idle-exclusion`, `inward-normals`, `mixed-faces`, `idle-coefficient`.
void warn_of_contact(const interpreter::Call& call, const solver::ContactDefinition& definition,
                     const solver::Model& model, interpreter::Diagnostics& diagnostics);

}  // namespace comma::commands
