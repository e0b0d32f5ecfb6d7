// The names that Code_Aster's results have: fields, their components, parameters.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/model.hpp"

namespace comma::commands {

/// Whether a mechanical result can have a field of this name (U4.81.04; UTnn_LOCATION is the user's own).
bool is_field_name(std::string_view name);
/// For hints.
std::vector<std::string> field_names();

/// The components that a field can have on the elements of a model, or nothing when comma does not know the field's.
/// Numbered ones stand as their letter: "V" for V1, V2 ... of the internal variables, "X" for X1, X2 ... of fields of
/// one's own.
std::optional<std::vector<std::string>> components_of_field(std::string_view field, const solver::Model& model);
bool has_component(const std::vector<std::string>& components, std::string_view name);

/// The parameters of a nonlinear result beside its fields.
const std::vector<std::string>& result_parameters();

}  // namespace comma::commands
