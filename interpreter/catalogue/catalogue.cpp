#include "interpreter/catalogue/catalogue.hpp"

#include <array>
#include <stdexcept>
#include <utility>

#include "interpreter/catalogue/catalogue_page.hpp"

namespace comma::interpreter {
namespace {

constexpr std::array<std::pair<Kind, std::string_view>, 17> kind_names{{{Kind::real, "real"},
                                                                        {Kind::integer, "integer"},
                                                                        {Kind::complex, "complex"},
                                                                        {Kind::text, "text"},
                                                                        {Kind::expression, "expression"},
                                                                        {Kind::node_group, "node_group"},
                                                                        {Kind::cell_group, "cell_group"},
                                                                        {Kind::node, "node"},
                                                                        {Kind::cell, "cell"},
                                                                        {Kind::component, "component"},
                                                                        {Kind::field, "field"},
                                                                        {Kind::parameter, "parameter"},
                                                                        {Kind::input_unit, "input_unit"},
                                                                        {Kind::output_unit, "output_unit"},
                                                                        {Kind::concept_kind, "concept"},
                                                                        {Kind::factor, "factor"},
                                                                        {Kind::anything, "anything"}}};

constexpr std::array<std::pair<RulePage::Kind, std::string_view>, 7> rule_names{
    {{RulePage::Kind::exactly_one, "exactly_one"},
     {RulePage::Kind::at_least_one, "at_least_one"},
     {RulePage::Kind::at_most_one, "at_most_one"},
     {RulePage::Kind::all_or_none, "all_or_none"},
     {RulePage::Kind::requires_all, "requires"},
     {RulePage::Kind::requires_one, "requires_one_of"},
     {RulePage::Kind::excludes, "excludes"}}};

template <class Enum, std::size_t n>
std::string_view name_in(const std::array<std::pair<Enum, std::string_view>, n>& names, Enum key) {
  for (const auto& [value, name] : names)
    if (value == key) return name;
  return "";
}

template <class Enum, std::size_t n>
std::optional<Enum> named_in(const std::array<std::pair<Enum, std::string_view>, n>& names, std::string_view word) {
  for (const auto& [value, name] : names)
    if (name == word) return value;
  return std::nullopt;
}

}  // namespace

std::string_view name_of(Kind kind) { return name_in(kind_names, kind); }

std::optional<Kind> kind_named(std::string_view word) {
  const auto kind = named_in(kind_names, word);
  return kind == Kind::concept_kind ? std::nullopt : kind;
}

bool holds_text(Kind kind) { return kind >= Kind::text && kind <= Kind::parameter; }

std::string_view name_of(RulePage::Kind kind) { return name_in(rule_names, kind); }

std::optional<RulePage::Kind> rule_named(std::string_view word) { return named_in(rule_names, word); }

Catalogue::Catalogue(std::span<const CatalogueBlob> blobs) {
  for (const CatalogueBlob& blob : blobs) blobs_.emplace(blob.name, blob.bytes);
}

bool Catalogue::has(std::string_view command) const { return !command.empty() && blobs_.contains(command); }

std::vector<std::string> Catalogue::names() const {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : blobs_)
    if (!name.empty()) names.push_back(name);
  return names;
}

const CommandPage& Catalogue::page(std::string_view command) const {
  const auto known = pages_.find(command);
  if (known != pages_.end()) return *known->second;
  const auto blob = blobs_.find(command);
  if (command.empty() || blob == blobs_.end()) throw std::out_of_range("no catalogue page for " + std::string(command));
  auto page = std::make_unique<CommandPage>(decode_page(blob->second));
  return *pages_.emplace(blob->first, std::move(page)).first->second;
}

const std::map<std::string, ConceptTypePage, std::less<>>& Catalogue::types() const {
  if (types_) return *types_;
  types_.emplace();
  const auto blob = blobs_.find("");
  if (blob == blobs_.end()) return *types_;
  for (ConceptTypePage& type : decode_types(blob->second)) types_->emplace(type.name, type);
  return *types_;
}

bool Catalogue::is_a(std::string_view type, std::string_view wanted) const {
  if (wanted == "any" || type == wanted) return true;
  const auto known = types().find(type);
  if (known == types().end()) return false;
  for (const std::string& parent : known->second.is_a)
    if (is_a(parent, wanted)) return true;
  return false;
}

std::string Catalogue::describe_type(std::string_view type) const {
  const auto known = types().find(type);
  return known == types().end() ? std::string(type) : known->second.doc;
}

std::string with_article(std::string_view noun) {
  const bool vowel = !noun.empty() && std::string_view("aeiouAEIO").find(noun.front()) != std::string_view::npos;
  return (vowel ? "an " : "a ") + std::string(noun);
}

}  // namespace comma::interpreter
