#include "interpreter/graph/concept.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "interpreter/diagnostic.hpp"
#include "interpreter/values/value.hpp"

namespace comma::interpreter {

namespace {

Value call_real(const RealFunction& function, const std::vector<Value>& arguments) {
  const auto& names = function.parameters();
  const std::size_t wanted = std::max<std::size_t>(names.size(), 1);
  const bool numbers =
      std::ranges::all_of(arguments, [](const Value& value) { return value.is_number() || value.is_bool(); });
  if (arguments.size() != wanted || !numbers) {
    throw DiagnosticError("type-error",
                          fmt::format("this function is called with {} number{}", wanted, wanted == 1 ? "" : "s"), {},
                          names.empty() ? "" : fmt::format("write F({})", fmt::join(names, ", ")));
  }
  std::vector<double> at;
  for (const Value& value : arguments)
    at.push_back(value.is_bool() ? static_cast<double>(value.as_bool()) : value.as_real());
  return Value(function.evaluate(at));
}

}  // namespace

Concept::~Concept() {
  std::vector<std::shared_ptr<Concept>> open = std::move(reads_through);
  while (!open.empty()) {
    const std::shared_ptr<Concept> last = std::move(open.back());
    open.pop_back();
    if (last.use_count() > 1) continue;
    std::ranges::move(last->reads_through, std::back_inserter(open));
    last->reads_through.clear();
  }
}

ConceptPtr source_behind(const Concept& made, std::string_view method) {
  const std::string_view type = method == "getMesh"            ? "maillage_sdaster"
                                : method == "getModel"         ? "modele_sdaster"
                                : method == "getMaterialField" ? "cham_mater"
                                                               : "";
  if (type.empty() || made.type == type) return nullptr;
  std::vector<ConceptPtr> open = made.reads_through;
  std::set<const Concept*> seen;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const ConceptPtr now = open[i];
    if (now->type == type) return now;
    if (seen.insert(now.get()).second) open.insert(open.end(), now->reads_through.begin(), now->reads_through.end());
  }
  return nullptr;
}

Value ConceptData::subscript(const Value&) const {
  throw DiagnosticError("not-supported", "this concept cannot be read by [...]");
}

Value ConceptData::call(const std::vector<Value>& arguments) const {
  if (const RealFunction* function = real_function()) return call_real(*function, arguments);
  throw DiagnosticError("not-supported", "this concept cannot be called like a function");
}

Value ConceptData::method(std::string_view name, const std::vector<Value>&, const std::map<std::string, Value>&) const {
  throw DiagnosticError("not-supported", fmt::format("this concept has no method {}", name), {},
                        did_you_mean(name, method_names()));
}

}  // namespace comma::interpreter
