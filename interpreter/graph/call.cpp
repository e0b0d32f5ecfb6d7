#include "interpreter/graph/call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace comma::interpreter {
namespace {

const Keyword* find(const std::vector<Keyword>& items, std::string_view name) {
  const auto found = std::ranges::find(items, name, &Keyword::name);
  return found == items.end() ? nullptr : &*found;
}

/// The values of a keyword that holds one or several; empty when it is absent.
std::vector<Value> values_of(const std::vector<Keyword>& items, std::string_view name) {
  const Keyword* keyword = find(items, name);
  if (keyword == nullptr) return {};
  if (!keyword->value.is_sequence()) return {keyword->value};
  const auto values = keyword->value.items();
  return {values.begin(), values.end()};
}

template <class T, class Convert>
std::vector<T> converted(const std::vector<Keyword>& items, std::string_view name, Convert convert) {
  std::vector<T> result;
  for (const Value& value : values_of(items, name)) result.push_back(convert(value));
  return result;
}

}  // namespace

bool Keywords::has(std::string_view keyword) const { return find(items, keyword) != nullptr; }

bool Keywords::given(std::string_view keyword) const {
  const Keyword* found = find(items, keyword);
  return found != nullptr && found->given;
}

const Keyword& Keywords::at(std::string_view keyword) const {
  const Keyword* found = find(items, keyword);
  if (found == nullptr) throw std::logic_error(fmt::format("keyword {} is absent from a checked call", keyword));
  return *found;
}

double Keywords::real(std::string_view keyword) const { return at(keyword).value.as_real(); }

std::int64_t Keywords::integer(std::string_view keyword) const { return at(keyword).value.as_integer(); }

const std::string& Keywords::text(std::string_view keyword) const { return at(keyword).value.as_text(); }

const ConceptPtr& Keywords::concept_of(std::string_view keyword) const { return at(keyword).value.as_concept(); }

std::vector<double> Keywords::reals(std::string_view keyword) const {
  return converted<double>(items, keyword, [](const Value& value) { return value.as_real(); });
}

std::vector<std::int64_t> Keywords::integers(std::string_view keyword) const {
  return converted<std::int64_t>(items, keyword, [](const Value& value) { return value.as_integer(); });
}

std::vector<std::string> Keywords::texts(std::string_view keyword) const {
  return converted<std::string>(items, keyword, [](const Value& value) { return value.as_text(); });
}

std::vector<ConceptPtr> Keywords::concepts(std::string_view keyword) const {
  return converted<ConceptPtr>(items, keyword, [](const Value& value) { return value.as_concept(); });
}

std::vector<ConceptPtr> Keywords::concepts_among(std::string_view keyword) const {
  auto handles = converted<ConceptPtr>(
      items, keyword, [](const Value& value) { return value.is_concept() ? value.as_concept() : ConceptPtr(); });
  std::erase(handles, nullptr);
  return handles;
}

const std::vector<Keywords>& Keywords::factors(std::string_view keyword) const {
  static const std::vector<Keywords> none;
  const Keyword* found = find(items, keyword);
  return found == nullptr ? none : found->factors;
}

const Keywords& Keywords::factor(std::string_view keyword) const {
  const std::vector<Keywords>& all = factors(keyword);
  if (all.size() != 1)
    throw std::logic_error(fmt::format("{} occurrences of {} where one is expected", all.size(), keyword));
  return all.front();
}

Span Keywords::span_of(std::string_view keyword) const {
  const Keyword* found = find(items, keyword);
  return found != nullptr && found->given ? found->value_span : span;
}

DiagnosticError destroyed_concept(const Concept& handle) {
  const Span& at = *handle.destroyed_at;
  return {"destroyed-concept",
          fmt::format("{} is not there any more: DETRUIRE has taken it away{}", handle.name,
                      at.file ? fmt::format(" (line {})", at.file->position(at.begin).line) : ""),
          Span(), "use it before, or leave DETRUIRE out"};
}

void throw_wrong_data(std::string_view keyword, const Concept* concept_handle) {
  if (concept_handle == nullptr) throw std::logic_error(fmt::format("keyword {} holds no concept", keyword));
  if (concept_handle->data == nullptr && concept_handle->destroyed_at) throw destroyed_concept(*concept_handle);
  const char* why =
      concept_handle->data == nullptr ? "has not been computed" : "holds data of another kind than expected";
  throw std::logic_error(
      fmt::format("{} ({}), the concept of keyword {}, {}", concept_handle->name, concept_handle->type, keyword, why));
}

}  // namespace comma::interpreter
