#include "interpreter/concept.hpp"

#include <fmt/format.h>

#include "interpreter/diagnostic.hpp"
#include "interpreter/value.hpp"

namespace comma::interpreter {

Value ConceptData::subscript(const Value&) const {
  throw DiagnosticError("not-supported", "this concept cannot be read by [...]");
}

Value ConceptData::call(const std::vector<Value>&) const {
  throw DiagnosticError("not-supported", "this concept cannot be called like a function");
}

Value ConceptData::method(std::string_view name, const std::vector<Value>&, const std::map<std::string, Value>&) const {
  throw DiagnosticError("not-supported", fmt::format("this concept has no method {}", name));
}

}  // namespace comma::interpreter
