// Fields taken of something that holds them already: of a result, a table, a mesh (CREA_CHAMP, OPERATION='EXTR';
// U4.72.04).
#pragma once

#include <memory>

#include "commands/concepts.hpp"
#include "commands/fields/field_types.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::commands {

/// NOM_CHAM of a step of RESULTAT; with INTERPOL='LIN' also between two steps; with TYPE_MAXI the extreme over the
/// steps. Throws DiagnosticError `unknown-step`, `unknown-field`, `incompatible-field`.
std::shared_ptr<FieldConcept> field_of_result(const interpreter::Call& call);

/// TABLE: one row a node (NOEUD), a cell (MAILLE), a node of a cell (MAILLE and NOEUD or POINT) or a Gauss point
/// (MAILLE and POINT), its columns named as components of the type; other columns do not count. Throws DiagnosticError
/// `unknown-column`, `unknown-node`, `unknown-cell`, `out-of-bounds`, `missing-keyword`.
std::shared_ptr<FieldConcept> field_of_table(const interpreter::Call& call, const FieldType& type);

}  // namespace comma::commands
