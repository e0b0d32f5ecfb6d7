// TYPE_CHAM: where the values of a field lie and what they are (U4.72.04).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/concepts.hpp"
#include "interpreter/graph/call.hpp"
#include "solver/fields/data/field_algebra.hpp"

namespace comma::commands {

enum class FieldPlace : std::uint8_t { node, zone, cell, element_node, gauss_point };

struct FieldType {
  FieldPlace place;
  std::string quantity;  ///< "TEMP", "SIEF" ...
  bool functions;        ///< TYPE_CHAM ends in _F: functions instead of numbers
  bool integers;         ///< TYPE_CHAM ends in _I

  std::string quantity_name() const { return quantity + "_R"; }
};

/// "NOEU_TEMP_F": functions that are temperatures at nodes.
FieldType field_type(const std::string& word);

/// Throws DiagnosticError `unknown-component` at `keyword` for a component that the quantity does not have, with the
/// nearest name.
void check_component(const interpreter::Keywords& keywords, const std::string& keyword, const FieldType& type,
                     const std::string& name);

/// Whether the quantity has such a component.
bool has_component(const FieldType& type, const std::string& name);

/// Where a field on elements has its values.
solver::Support support_of(FieldPlace place);

/// Whether a field has its values at such places.
bool lies_at(const solver::Field& field, FieldPlace place);
/// "at nodes" ... for messages.
std::string describe(FieldPlace place);
FieldPlace place_of(const solver::Field& field);

/// Whether elements of skin carry the quantity too: those that live inside elements are theirs alone.
bool lives_on_skin(const FieldType& type);

/// The field behind a concept, which must hold numbers. Throws DiagnosticError `wrong-type` at `keyword` for one of
/// functions.
const FieldConcept& number_field(const interpreter::ConceptPtr& handle, const interpreter::Keywords& keywords,
                                 const char* keyword);

/// What a command makes of values must be numbers. Throws DiagnosticError `not-finite` at `span`, naming the first
/// place where one is not; `maker` names the command.
void require_finite(const solver::Field& field, const solver::Mesh& mesh, const std::string& maker,
                    const interpreter::Span& span);

/// The functions of a field of functions, for solver::evaluate.
std::vector<solver::ValueFunction> value_functions(const FieldConcept& data);

}  // namespace comma::commands
