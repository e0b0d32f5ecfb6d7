// Which type of concept a call gives, by the keywords that it was checked to have.
#pragma once

#include <optional>
#include <string>

#include "interpreter/catalogue/catalogue.hpp"
#include "interpreter/catalogue/keyword_scope.hpp"
#include "interpreter/graph/call.hpp"

namespace comma::interpreter {

/// The type of the concept that a call gives: empty where it gives none, nothing where it depends on a value that is
/// not known. `scope` is what the conditions of the page's products are judged by, `keywords` the same call as checked.
std::optional<std::string> product_type(const CommandPage& page, const KeywordScope& scope, const Keywords& keywords,
                                        const Catalogue& catalogue);

}  // namespace comma::interpreter
