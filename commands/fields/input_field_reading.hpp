// CREA_CHAMP, OPERATION='EXTR' out of what a computation is given: CARA_ELEM and CHARGE (U4.72.04).
#pragma once

#include <memory>

#include "commands/concepts.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// The data that NOM_CHAM names (".CARCOQUE" ...) of the elements of CARA_ELEM. Throws DiagnosticError `unknown-field`
/// if none of the elements has them.
std::shared_ptr<FieldConcept> field_of_characteristics(const interpreter::Call& call);

/// The forces that NOM_CHAM names (".CHME.F1D3D" ...) of the load CHARGE. Throws DiagnosticError `unknown-field` if it
/// has none, `unsupported` for forces that are given by functions.
std::shared_ptr<FieldConcept> field_of_load(const interpreter::Call& call);

}  // namespace comma::commands
